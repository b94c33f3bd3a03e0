// @ts-check
import uPlot from "/static/vendor/uplot/uPlot.esm.js";
import { Envelope } from "./envelope.js";
import { Figure } from "./figure.js";
import { axis, fit, padded, themed } from "./plot_style.js";

/** @typedef {import("./view.js").View} View @typedef {import("./figure.js").Series} Series */

/** A chart of signals against time, drawn as the minimum and maximum of every pixel column. */
export class TimeChart {
  visible = false;

  /** @param {View} view @param {string} title @param {string} unit @param {Series[]} series */
  constructor(view, title, unit, series) {
    this.view = view;
    this.series = series;
    this.channels = series.map((one) => one.index);
    this.figure = new Figure(title, unit, series, true);
    this.envelope = new Envelope(series.length);
    this.box = this.figure.plot;
    /** @type {uPlot | null} */
    this.plot = null;
    this.box.addEventListener("keydown", (/** @type {KeyboardEvent} */ event) => this.#key(event));
    view.add(this.figure.element, this);
  }

  draw() {
    this.plot ??= this.#create();
    const [from, to] = this.view.range();
    const columns = Math.max(50, Math.round(this.plot.bbox.width));
    this.envelope.fill(this.view.store, this.channels, from, to, columns);
    this.plot.setData(this.envelope.views);
  }

  readout() {
    const { store } = this.view;
    const plot = this.plot;
    const left = plot?.cursor.left ?? -1;
    const at = plot && left >= 0 ? Math.max(0, Math.round(plot.posToVal(left, "x") / store.step) - 1) : -1;
    const k = at >= 0 && at < store.count ? at : store.count - 1;
    const values = this.channels.map((channel) => (k < 0 ? NaN : store.last[channel][k]));
    this.figure.show(k < 0 ? null : store.time(k), values, k === at && at >= 0);
  }

  #create() {
    const view = this.view;
    const plot = new uPlot(
      {
        width: this.box.clientWidth,
        height: this.box.clientHeight,
        legend: { show: false },
        scales: { x: { time: false, range: () => view.range() }, y: { range: (_, low, high) => padded(low, high) } },
        axes: [axis("Time, s", 34), axis(undefined, 52)],
        series: [
          {},
          ...this.series.map((one) => ({ stroke: () => themed(one.colour), width: one.width ?? 1.25, points: { show: false } })),
        ],
        cursor: {
          sync: { key: "time", setSeries: false },
          points: { show: false },
          y: false,
          drag: { x: true, y: false, setScale: false },
          bind: { dblclick: () => () => (view.zoomTo(null), null) },
        },
        hooks: { setSelect: [(u) => this.#selected(u)], setCursor: [() => this.readout()] },
      },
      [new Float64Array(0), ...this.series.map(() => new Float32Array(0))],
      this.box,
    );
    fit(this.box, (width, height) => {
      plot.setSize({ width, height });
      view.redraw();
    });
    return plot;
  }

  /** @param {any} u */
  #selected(u) {
    const { left, width } = u.select;
    if (width < 4) return;
    const range = [u.posToVal(left, "x"), u.posToVal(left + width, "x")];
    u.setSelect({ left: 0, width: 0, top: 0, height: 0 }, false);
    this.view.zoomTo(/** @type {[number, number]} */ (range));
  }

  /** @param {KeyboardEvent} event */
  #key(event) {
    const plot = this.plot;
    if (!plot || event.ctrlKey || event.metaKey || event.altKey) return;
    const [from, to] = this.view.range();
    const width = this.box.querySelector(".u-over").clientWidth;
    const { left: cursor = -1 } = plot.cursor;
    const left = cursor >= 0 ? cursor : width / 2;
    const zoom = (/** @type {number} */ factor) => {
      const centre = plot.posToVal(left, "x");
      this.view.zoomTo([Math.max(0, centre - (centre - from) * factor), Math.min(this.view.store.end, centre + (to - centre) * factor)]);
    };
    const step = event.shiftKey ? 20 : 2;
    if (event.key === "ArrowLeft" || event.key === "ArrowRight") {
      const next = Math.min(width, Math.max(0, left + (event.key === "ArrowLeft" ? -step : step)));
      plot.setCursor({ left: next, top: 10 });
    } else if (event.key === "+" || event.key === "=") zoom(0.5);
    else if (event.key === "-") zoom(2);
    else if (event.key === "Escape") this.view.zoomTo(null);
    else return;
    event.preventDefault();
  }
}
