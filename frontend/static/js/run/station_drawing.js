// @ts-check
import { line, move, svg } from "./svg.js";

/** @typedef {import("./building.js").Frame} Frame @typedef {import("./margin.js").Margin} Margin */

/** A station in its storey: two braces up to an apex that moves with the floor below, and the damper from the apex to the floor above. */
export class StationDrawing {
  /** @param {Frame} frame @param {number} storey from 1 @param {number} number of the station, from 1 @param {number} order among the stations of the storey @param {number} beside stations in the storey */
  constructor({ lines, levels, left, right }, storey, number, order, beside) {
    this.storey = storey;
    const [bottom, top] = [levels[storey - 1], levels[storey]];
    const tall = bottom - top;
    const braced = beside === 1 && lines.length > 2 ? [lines[1], lines[2]] : null;
    const share = (right - left) / beside;
    const [a, b] = braced ?? [left + order * share + 0.08 * share, left + (order + 1) * share - 0.08 * share];
    const gap = Math.min(26, Math.max(8, 0.3 * tall));
    const middle = (a + b) / 2;
    const long = Math.min(64, Math.max(16, 0.42 * (b - a)));
    const body = { long: 0.56 * long, deep: Math.min(12, 0.55 * gap) };
    const y = top + gap * 0.62;
    // drawn around the apex; the braces and the cylinder move with the floor below, the bracket and the rod with the floor above
    const legs = svg("path", { class: "brace", d: `M${a} ${bottom}L${middle} ${top + gap}L${b} ${bottom}M${middle - body.long / 2} ${top + gap}H${middle + body.long / 2}` });
    const cylinder = svg("rect", { class: "cylinder", x: middle - body.long / 2, y: y - body.deep / 2, width: body.long, height: body.deep, rx: 2 });
    this.below = svg("g", {}, legs, cylinder);
    const end = middle + body.long / 2 + 0.35 * long;
    const piston = line("piston", middle, y - body.deep / 2 + 1.5, middle, y + body.deep / 2 - 1.5);
    this.above = svg("g", {}, line("rod", middle, y, end, y), piston, line("rod", end, y, end, top));
    this.element = svg("g", { class: "damper" }, this.below, this.above);
    const size = Math.min(10, Math.max(6, tall * 0.2));
    this.ring = svg("circle", { class: "station-ring", r: size, "data-margin": "none" });
    const label = svg("text", { class: "ring-number", y: size * 0.38, "font-size": size * 1.15 }, String(number));
    this.badge = svg("g", {}, this.ring, label);
    this.at = { x: middle, y: Math.min(bottom - size - 2, top + gap + size + 0.22 * tall) };
  }

  /** @param {number[]} moved pixels of the ground and of each floor @param {Margin} [margin] */
  show(moved, margin) {
    const [below, above] = [moved[this.storey - 1], moved[this.storey]];
    move(this.below, below);
    move(this.above, above);
    move(this.badge, this.at.x + below, this.at.y);
    if (margin && this.ring.dataset.margin !== margin.level) this.ring.dataset.margin = margin.level;
  }
}
