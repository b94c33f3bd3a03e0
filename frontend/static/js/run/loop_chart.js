// @ts-check
import uPlot from "/static/vendor/uplot/uPlot.esm.js";
import { Figure } from "./figure.js";
import { axis, fit, padded, themed } from "./plot_style.js";

/** @typedef {import("./view.js").View} View @typedef {import("./figure.js").Series} Series */

/** A chart of one signal against another: the last sample of each bucket in the shown time range. */
export class LoopChart {
  visible = false;

  /** @param {View} view @param {string} title @param {Series} x @param {Series} y @param {boolean} [alike] equal axes, and a line where both signals are equal */
  constructor(view, title, x, y, alike = false) {
    this.view = view;
    this.alike = alike;
    this.x = x;
    this.y = y;
    this.figure = new Figure(x.unit === y.unit ? `${title}, ${x.unit}` : `${title}, ${y.unit} and ${x.unit}`, "", [x, y], false);
    this.box = this.figure.plot;
    /** @type {uPlot | null} */
    this.plot = null;
    view.add(this.figure.element, this);
  }

  draw() {
    this.plot ??= this.#create();
    this.plot.setData(this.#points());
  }

  readout() {
    const { store } = this.view;
    const k = store.count - 1;
    const values = [this.x, this.y].map((one) => (k < 0 ? NaN : store.last[one.index][k]));
    this.figure.show(k < 0 ? null : store.time(k), values, false);
  }

  /** The data for uPlot's mode 2: null, then x and y of each series. @returns {any} */
  #points() {
    const { store } = this.view;
    const [from, to] = this.view.range();
    const first = Math.max(0, Math.floor(from / store.step));
    const end = Math.max(first, Math.min(store.count, Math.ceil(to / store.step)));
    const points = [store.last[this.x.index].subarray(first, end), store.last[this.y.index].subarray(first, end)];
    return this.alike ? [null, [this.#range(), this.#range()], points] : [null, points];
  }

  /** The range of one channel, or of both channels if the axes are equal. @param {number} [channel] @returns {[number, number]} */
  #range(channel) {
    const { lowest, highest } = this.view.store;
    const shown = this.alike || channel === undefined ? [this.x.index, this.y.index] : [channel];
    return padded(Math.min(...shown.map((k) => lowest[k])), Math.max(...shown.map((k) => highest[k])));
  }

  #create() {
    const around = (/** @type {number} */ channel) => () => this.#range(channel);
    const named = (/** @type {Series} */ one) => (one.unit ? `${one.label}, ${one.unit}` : one.label);
    const plot = new uPlot(
      {
        mode: 2,
        width: this.box.clientWidth,
        height: this.box.clientHeight,
        legend: { show: false },
        cursor: { show: false },
        scales: { x: { time: false, range: around(this.x.index) }, y: { range: around(this.y.index) } },
        axes: [axis(named(this.x), 34), axis(undefined, 52)],
        series: /** @type {any[]} */ ([null, ...(this.alike ? [line("equal", "--line-wide", 2)] : []), line(this.y.label, this.y.colour, 1)]),
      },
      this.#points(),
      this.box,
    );
    fit(this.box, (width, height) => {
      plot.setSize({ width, height });
      this.view.redraw();
    });
    return plot;
  }
}

/** @param {string} label @param {string} colour @param {number} width */
const line = (label, colour, width) => ({
  label,
  stroke: () => themed(colour),
  width,
  facets: [
    { scale: "x", auto: true },
    { scale: "y", auto: true },
  ],
  paths: loopPath,
});

/** A path through all points in order, without points on the same pixel as the point before. @param {any} u @param {number} series */
export function loopPath(u, series) {
  const [xs, ys] = u.data[series];
  const { left, top, width, height } = u.bbox;
  const [x, y] = [u.scales.x, u.scales.y];
  const [px, py] = [width / (x.max - x.min), height / (y.max - y.min)];
  const stroke = new Path2D();
  let [lastX, lastY] = [NaN, NaN];
  for (let i = 0; i < xs.length; i++) {
    const atX = Math.round(left + (xs[i] - x.min) * px);
    const atY = Math.round(top + height - (ys[i] - y.min) * py);
    if (atX === lastX && atY === lastY) continue;
    if (i) stroke.lineTo(atX, atY);
    else stroke.moveTo(atX, atY);
    lastX = atX;
    lastY = atY;
  }
  return { stroke, fill: null, clip: null, band: null, gaps: null, flags: 1 };
}
