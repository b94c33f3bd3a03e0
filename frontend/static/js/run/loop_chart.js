// @ts-check
import { Figure } from "./figure.js";
import { Loop } from "./loop.js";

/** @typedef {import("./view.js").View} View @typedef {import("./figure.js").Series} Series */

const STEPS = 20; // of a window that moves on: the loop drops old samples in steps, each of which draws it anew

/** A loop in a figure that follows the view: its window, the replay and the cursor of the time charts. */
export class LoopChart {
  visible = false;

  /** @param {View} view @param {string} title @param {Series} x @param {Series} y @param {boolean} [alike] equal axes, and a line where both signals are equal */
  constructor(view, title, x, y, alike = false) {
    this.view = view;
    this.x = x;
    this.y = y;
    this.figure = new Figure(title, "", [x, y], false);
    this.loop = new Loop(this.figure.plot, x, y, alike);
    view.add(this.figure.element, this);
    new ResizeObserver(() => this.visible && view.redraw()).observe(this.figure.plot);
  }

  draw() {
    const { view } = this;
    const [start, to] = view.range();
    const step = view.zoom || view.window === null ? 0 : view.window / STEPS;
    const from = step ? Math.floor(start / step) * step : start;
    this.loop.draw(view.store, { from, to, until: view.until(), head: view.pointed(), close: view.zoom !== null, ended: view.ended });
  }

  follow() {
    this.draw();
  }

  readout() {
    const { store } = this.view;
    const k = store.at(this.view.pointed());
    const values = [this.x, this.y].map((one) => (k < 0 ? NaN : store.last[one.index][k]));
    this.figure.show(k < 0 ? null : store.time(k), values, this.view.cursor !== null || this.view.head !== null);
  }
}
