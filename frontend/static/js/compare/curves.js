// @ts-check
import uPlot from "/static/vendor/uplot/uPlot.esm.js";
import { el } from "../dom.js";
import { axis, fit, themed } from "../run/plot_style.js";
import { look } from "./looks.js";

/** @typedef {import("./view.js").View} View */

const EMPTY = /** @type {uPlot.AlignedData} */ ([[0, 1], [0, 1]]);
const FADED = { beside: 0.55, alone: 0.15 }; // opacity of the other curves while one is highlighted

/** A chart whose curves this program draws on uPlot's canvas: curves have their own steps, and the highlighted one is on top. */
export class Curves {
  visible = false;
  /** @type {uPlot | null} */
  plot = null;

  /** @param {View} view @param {string} title @param {string} about description for screen readers @param {[string, string]} axes labels of the axes */
  constructor(view, title, about, axes) {
    this.view = view;
    this.title = title;
    this.axes = axes;
    this.box = el("div", { class: "plot", role: "img", tabindex: "0", "aria-label": about });
    this.empty = el("p", { class: "muted", hidden: true }, "No item that is shown has these signals.");
    this.element = el("figure", { class: "chart" }, el("figcaption", {}, el("strong", {}, title)), this.box, this.empty);
    view.add(this.element, this);
  }

  draw() {
    this.plot ??= this.#create();
    this.plot.setData(EMPTY); // asks for the ranges again, and draws
  }

  cursor() {}

  /** The ranges of both axes. @returns {[[number, number], [number, number]]} */
  ranges() {
    throw new Error("a chart says what its ranges are");
  }

  /** The path of an item in canvas pixels; null where the item has no such signal. @param {number} _item @param {Place} _place @returns {Path2D | null} */
  path(_item, _place) {
    throw new Error("a chart says what its paths are");
  }

  /** More options of the chart. @returns {Partial<uPlot.Options>} */
  options() {
    return {};
  }

  #create() {
    const plot = new uPlot(
      {
        width: this.box.clientWidth,
        height: this.box.clientHeight,
        legend: { show: false },
        scales: { x: { time: false, range: () => this.ranges()[0] }, y: { range: () => this.ranges()[1] } },
        axes: [axis(this.axes[0], 34), axis(undefined, 52)],
        series: [{}, { show: true, paths: () => null, points: { show: false } }],
        ...this.options(),
        hooks: { ...this.options().hooks, draw: [(u) => this.#curves(u)] },
      },
      EMPTY,
      this.box,
    );
    fit(this.box, (width, height) => {
      plot.setSize({ width, height });
      this.view.changed();
    });
    return plot;
  }

  /** @param {uPlot} u */
  #curves(u) {
    const { ctx, bbox, scales } = u;
    const { view } = this;
    const place = new Place(bbox, scales.x, scales.y);
    const ratio = devicePixelRatio || 1;
    ctx.save();
    ctx.beginPath();
    ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
    ctx.clip();
    ctx.lineJoin = "round";
    let drawn = 0;
    for (const item of view.order()) {
      const path = this.path(item, place);
      if (!path) continue;
      drawn += 1;
      const { colour, dash } = look(item);
      const chosen = item === view.highlighted;
      ctx.strokeStyle = themed(colour);
      ctx.globalAlpha = view.highlighted === null || chosen ? 1 : view.alone ? FADED.alone : FADED.beside;
      ctx.lineWidth = ratio * (chosen ? 2.4 : item === view.reference ? 1.8 : 1.2);
      ctx.setLineDash(dash.map((length) => length * ratio));
      ctx.stroke(path);
    }
    ctx.restore();
    this.empty.hidden = drawn > 0;
  }
}

/** Where values are on the canvas. */
export class Place {
  /** @param {{left: number, top: number, width: number, height: number}} box @param {any} x @param {any} y */
  constructor({ left, top, width, height }, x, y) {
    this.perX = width / (x.max - x.min);
    this.perY = height / (y.max - y.min);
    this.left = left - x.min * this.perX;
    this.base = top + height + y.min * this.perY;
  }

  /** @param {number} value */
  x(value) {
    return this.left + value * this.perX;
  }

  /** @param {number} value */
  y(value) {
    return this.base - value * this.perY;
  }
}
