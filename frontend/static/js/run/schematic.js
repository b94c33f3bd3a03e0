// @ts-check
import { el } from "../dom.js";
import { BuildingDrawing } from "./building_drawing.js";
import { RigDrawing } from "./rig_drawing.js";
import { svg } from "./svg.js";

/** @typedef {import("./store.js").Channel} Channel @typedef {import("./store.js").Moment} Moment @typedef {import("./margin.js").Margin} Margin */

const LEAST = { width: 200, height: 90 }; // pixels: smaller boxes, such as those of a page that is being laid out, have no room for a drawing
const FONT = 14; // pixels: font size of a box at which the drawing has its own size; a larger font enlarges everything

/**
 * What is tested, drawn and moving to scale: the building with its stations, or the rig of a specimen or an actuator alone.
 *
 *     const schematic = new Schematic(host, plan, channels);
 *     schematic.show(store.moment(), gauges.show(store.moment()));
 */
export class Schematic {
  /** @param {HTMLElement} host @param {any} plan @param {Channel[]} channels of the live schema */
  constructor(host, plan, channels) {
    const Drawing = plan.structure.kind === "none" ? RigDrawing : BuildingDrawing;
    this.root = svg("svg", { role: "img", "aria-label": Drawing.named(plan) });
    this.caption = el("figcaption", { class: "schematic-caption" });
    this.box = el("div", { class: "schematic-box" }, this.root);
    this.element = el("figure", { class: "schematic" }, this.box, this.caption);
    host.replaceChildren(this.element);
    this.drawing = new Drawing(this.root, plan, channels, (/** @type {string} */ words) => (this.caption.textContent = words));
    /** @type {[Moment, Margin[]] | null} */
    this.last = null;
    new ResizeObserver(() => this.fit()).observe(this.box);
    this.fit();
  }

  /** Draw at the present size of the box. */
  fit() {
    const { clientWidth, clientHeight } = this.box;
    const scale = parseFloat(getComputedStyle(this.box).fontSize) / FONT;
    const [width, height] = [clientWidth / scale, clientHeight / scale];
    if (!(width >= LEAST.width && height >= LEAST.height)) return; // also without a size: not in the page yet
    this.root.setAttribute("viewBox", `0 0 ${width} ${height}`);
    this.drawing.build(width, height);
    if (this.last) this.drawing.show(...this.last, true);
  }

  /** Show a moment. @param {Moment} moment @param {Margin[]} [margins] of the stations, which colour their numbers @param {boolean} [numbers] whether the numbers change too */
  show(moment, margins = [], numbers = true) {
    this.last = [moment, margins];
    if (this.root.hasAttribute("viewBox")) this.drawing.show(moment, margins, numbers);
  }
}
