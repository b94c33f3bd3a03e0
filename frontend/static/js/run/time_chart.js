// @ts-check
import uPlot from "/static/vendor/uplot/uPlot.esm.js";
import { el } from "../dom.js";
import { significant } from "../format.js";
import { drawColumns } from "./columns.js";
import { Envelope } from "./envelope.js";
import { Figure } from "./figure.js";
import { axis, fit, padded, themed } from "./plot_style.js";
import { drawLimits, drawNotes, drawTrip } from "./time_marks.js";
import { zoomKey } from "./zoom_keys.js";

/** @typedef {import("./view.js").View} View @typedef {import("./figure.js").Series} Series */

/**
 * `limit` in both directions: a line once the signal comes near it. `bare`: no labels on the time axis, for a chart above another
 * on the same axis. @typedef {{limit?: number | null, bare?: boolean}} Options
 */

const LINE = /** @type {uPlot.Series.LinearPathBuilderFactory} */ (uPlot.paths.linear)();
const FONT = 12; // pixels: lines of a chart with a larger font are wider
const SEEN = 0.5; // of a limit: from here on the axis includes the limit
const NARROW = 640; // pixels of a box that leaves little room for the labels of an axis

/** A chart of signals against time, drawn as the minimum and maximum of every pixel column. */
export class TimeChart {
  visible = false;

  /** @param {View} view @param {string} title @param {string} unit @param {Series[]} series @param {Options} [options] */
  constructor(view, title, unit, series, { limit = null, bare = false } = {}) {
    this.view = view;
    this.series = series;
    this.channels = series.map((one) => one.index);
    this.limit = limit;
    this.styles = series;
    this.bare = bare;
    this.figure = new Figure(title, unit, series, true);
    if (limit) this.figure.note(`limit ± ${significant(limit)} ${unit}`);
    this.envelope = new Envelope(series.length);
    this.box = this.figure.plot;
    this.veil = el("div", { class: "veil", hidden: true });
    /** @type {uPlot | null} */
    this.plot = null;
    this.box.addEventListener("keydown", (/** @type {KeyboardEvent} */ event) => this.plot && zoomKey(event, this.plot, view));
    this.box.addEventListener("blur", () => this.plot?.setCursor({ left: -10, top: -10 }));
    view.add(this.figure.element, this);
  }

  draw() {
    this.plot ??= this.#create();
    const [from, to] = this.view.range();
    const columns = Math.max(50, Math.round(this.plot.bbox.width));
    this.envelope.fill(this.view.store, this.channels, from, to, columns);
    this.plot.setData(/** @type {any} */ (this.envelope.views));
    this.follow();
  }

  /** Dim what lies after the moment of a replay. */
  follow() {
    const { head } = this.view;
    this.veil.hidden = head === null;
    if (head === null) return;
    const [from, to] = this.view.range();
    const share = Math.min(1, Math.max(0, (head - from) / (to - from)));
    this.veil.style.left = `${(100 * share).toFixed(3)}%`;
  }

  readout() {
    const { store, cursor, head } = this.view;
    const k = store.at(this.view.pointed());
    const values = this.channels.map((channel) => (k < 0 ? NaN : store.last[channel][k]));
    this.figure.show(k < 0 ? null : store.time(k), values, cursor !== null || head !== null);
  }

  /** Take the chart out of the page. */
  close() {
    this.view.remove(this.figure.element);
    this.plot?.destroy();
    this.figure.element.remove();
  }

  /** The y axis: what is shown, and the limit once the signal has come near it. @param {number} low @param {number} high @returns {[number, number]} */
  #range(low, high) {
    const { limit } = this;
    const seen = limit && Math.max(-low, high) >= SEEN * limit;
    return seen ? padded(Math.min(low, -limit), Math.max(high, limit)) : padded(low, high);
  }

  #create() {
    const view = this.view;
    const font = Math.max(11, Math.round(parseFloat(getComputedStyle(this.box).fontSize) * 0.8));
    const below = axis(this.bare ? undefined : "Time, s", this.bare ? 6 : font * 1.6, font);
    const beside = { ...axis(undefined, this.box.clientWidth < NARROW ? font * 4 : font * 4.6, font), space: 1.5 * font };
    this.styles = this.series.map((one) => ({ ...one, width: (one.width ?? 1.25) * Math.max(1, font / FONT) }));
    const plot = new uPlot(
      {
        width: this.box.clientWidth,
        height: this.box.clientHeight,
        padding: [Math.max(6, 0.55 * font), Math.max(10, font), 0, 0],
        legend: { show: false },
        scales: { x: { time: false, range: () => view.range() }, y: { range: (_, low, high) => this.#range(low, high) } },
        axes: [this.bare ? { ...below, values: () => [], ticks: { show: false } } : below, beside],
        series: [{}, ...this.styles.map(({ colour, width, dash }) => ({ stroke: () => themed(colour), width, dash, points: { show: false }, paths: this.#path }))],
        cursor: {
          sync: { key: "time", setSeries: false },
          points: { show: false },
          y: false,
          drag: { x: true, y: false, setScale: false },
          bind: { dblclick: () => () => (view.zoomTo(null), null) },
        },
        hooks: {
          setSelect: [(u) => this.#selected(u)],
          setCursor: [(u) => this.#pointed(u)],
          drawAxes: [(u) => this.limit && drawLimits(u, this.limit)],
          drawSeries: [(u, i) => this.#barred(i) && drawColumns(u, this.envelope, i - 1, this.styles[i - 1])],
          draw: [(u) => drawNotes(u, view.notes), (u) => view.trip && drawTrip(u, view.trip.time_s)],
        },
      },
      [new Float64Array(0), ...this.series.map(() => new Float32Array(0))],
      this.box,
    );
    plot.over.append(this.veil);
    fit(this.box, () => this.resize() && view.redraw());
    return plot;
  }

  /** Give the plot the size of its box; returns whether it changed. */
  resize() {
    const { plot } = this;
    const { clientWidth: width, clientHeight: height } = this.box;
    if (!plot || !width || !height || (width === plot.width && height === plot.height)) return false;
    plot.setSize({ width, height });
    return true;
  }

  /** Whether a series is drawn as a bar in each pixel column: a dashed line is not. @param {number} i of uPlot */
  #barred = (i) => this.envelope.dense && !this.series[i - 1].dash;

  /** The line of a series that is not drawn as bars. @type {uPlot.Series.PathBuilder} */
  #path = (u, i, first, last) => (this.#barred(i) ? null : LINE(u, i, first, last));

  /** @param {uPlot} u */
  #pointed(u) {
    const { left = -1 } = u.cursor;
    this.view.point(left < 0 ? null : Math.max(0, u.posToVal(left, "x")));
  }

  /** @param {any} u */
  #selected(u) {
    const { left, width } = u.select;
    if (width < 4) return;
    const range = [u.posToVal(left, "x"), u.posToVal(left + width, "x")];
    u.setSelect({ left: 0, width: 0, top: 0, height: 0 }, false);
    this.view.zoomTo(/** @type {[number, number]} */ (range));
  }
}
