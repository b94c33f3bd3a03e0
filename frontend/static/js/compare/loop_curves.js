// @ts-check
import { padded } from "../run/plot_style.js";
import { Curves } from "./curves.js";
import { within } from "./signals.js";

/** @typedef {import("./view.js").View} View */

/** One signal of all items against another, in the shown time range. */
export class LoopCurves extends Curves {
  /** @param {View} view @param {string} title @param {{role: string, label: string, unit: string}} x @param {{role: string, label: string, unit: string}} y */
  constructor(view, title, x, y) {
    const axes = /** @type {[string, string]} */ ([x, y].map(({ label, unit }) => `${label}, ${unit}`));
    super(view, `${title}, ${y.unit}${x.unit === y.unit ? "" : ` and ${x.unit}`}`, `${title}: ${axes[1]} against ${axes[0]}, all items.`, axes);
    this.roles = [x.role, y.role];
  }

  /** Both signals of an item in the shown time range, with the same number of samples. @param {number} item @returns {[Float32Array, Float32Array] | null} */
  #pair(item) {
    const [x, y] = this.roles.map((role) => this.view.signals.get(item, role, "samples"));
    if (!x || !y) return null;
    const [first, end] = within(x, this.view.range());
    return [x.values.subarray(first, end), y.values.subarray(first, end)];
  }

  /** @returns {[[number, number], [number, number]]} */
  ranges() {
    const ends = [[Infinity, -Infinity], [Infinity, -Infinity]];
    for (const item of this.view.order()) {
      this.#pair(item)?.forEach((values, axis) => {
        for (const value of values) {
          if (value < ends[axis][0] && value > -Infinity) ends[axis][0] = value;
          if (value > ends[axis][1] && value < Infinity) ends[axis][1] = value;
        }
      });
    }
    return /** @type {any} */ (ends.map(([low, high]) => padded(low, high)));
  }

  /** @param {number} item @param {import("./curves.js").Place} place */
  path(item, place) {
    const pair = this.#pair(item);
    if (!pair) return null;
    const path = new Path2D();
    const [xs, ys] = pair;
    let drawing = false;
    for (let k = 0; k < xs.length; k++) {
      if (!Number.isFinite(xs[k]) || !Number.isFinite(ys[k])) {
        drawing = false;
        continue;
      }
      if (drawing) path.lineTo(place.x(xs[k]), place.y(ys[k]));
      else path.moveTo(place.x(xs[k]), place.y(ys[k]));
      drawing = true;
    }
    return path;
  }

  /** @returns {any} */
  options() {
    return { cursor: { show: false } };
  }
}
