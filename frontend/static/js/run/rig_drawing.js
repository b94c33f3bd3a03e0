// @ts-check
import { fixed, significant } from "../format.js";
import { limitOn } from "./limits.js";
import { change, line, move, svg, text } from "./svg.js";

/** @typedef {import("./store.js").Channel} Channel @typedef {import("./store.js").Moment} Moment @typedef {import("./margin.js").Margin} Margin */

const WALL = 16; // pixels
const BEYOND = 1.12; // of the stroke limit: the end of the ruler

/** The rig of a test without structure: reaction, actuator, load cell and specimen. The rod and the ruler have one scale. */
export class RigDrawing {
  /** @param {any} plan */
  static named(plan) {
    return `Drawing of the rig: an actuator moves the specimen ${plan.stations[0].name} against a reaction. Gauges and charts show the same values as numbers.`;
  }

  /** @param {SVGElement} root @param {any} plan @param {Channel[]} channels @param {(words: string) => void} say */
  constructor(root, plan, channels, say) {
    this.root = root;
    this.say = say;
    this.station = plan.stations[0];
    const of = (/** @type {string} */ role) => channels.findIndex((one) => one.role === role && one.number === 1);
    this.index = { command: of("x_cmd"), measured: of("x_meas"), force: of("f_meas"), current: of("current") };
    this.channels = channels;
    this.limit = limitOn(plan, channels[this.index.command]) ?? 1;
    this.forceLimit = limitOn(plan, channels[this.index.force]) ?? 1;
  }

  /** @param {number} width @param {number} height */
  build(width, height) {
    const tall = Math.min(height * 0.4, 0.3 * width, 170);
    const y = Math.max(tall / 2 + 26, height * 0.38);
    const [left, right] = [6, width - 6];
    const inner = right - left - 2 * WALL;
    const reach = Math.min(0.17 * inner, 160); // pixels at the limit
    const [body, device] = [0.26 * inner, 0.26 * inner];
    const cell = left + WALL + body + reach + 10;
    const joint = cell + 18 + 0.06 * inner;
    this.pixels = reach / this.limit;
    this.ruler = { x: joint, y: y + tall / 2 + 34 };
    const deep = tall * 0.42;
    const far = right - WALL;
    this.moving = svg(
      "g",
      {},
      line("rod thick", left + WALL + body * 0.55, y, joint, y),
      svg("rect", { class: "piston-head", x: left + WALL + body * 0.55 - 5, y: y - deep / 2 + 4, width: 10, height: deep - 8 }),
      svg("rect", { class: "cell", x: cell, y: y - 9, width: 18, height: 18, rx: 2 }),
      line("rod", joint, y, far - device * 0.5, y),
      line("piston", far - device * 0.5, y - deep * 0.36, far - device * 0.5, y + deep * 0.36),
      line("pointer", joint, y + 5, joint, this.ruler.y - 2),
      svg("circle", { class: "joint", cx: joint, cy: y, r: 4 }),
    );
    this.force = svg("g", {}, line("force", 0, 0, 0, 0), svg("path", { class: "force-head" }));
    move(this.force, joint, y - deep / 2 - 14);
    this.command = svg("path", { class: "command-mark", d: "M0 4l-6 11h12z" });
    this.measured = svg("path", { class: "measured-mark", d: "M0 -2l-6 -11h12z" });
    this.words = text("rig-text strong", joint, y - deep / 2 - 24, "");
    const { controller, specimen, actuator } = this.station;
    this.current = text("rig-text", far - device * 0.55, y + deep / 2 + 18, controller && controller.kind !== "none" ? "current" : "");
    this.root.replaceChildren(
      this.#wall(left, y, tall),
      this.#wall(right - WALL, y, tall),
      svg("rect", { class: "actuator", x: left + WALL, y: y - deep / 2, width: body, height: deep, rx: 3 }),
      svg("rect", { class: "cylinder", x: far - device * 0.82, y: y - deep * 0.4, width: device * 0.6, height: deep * 0.8, rx: 3 }),
      line("rod thick", far - device * 0.22, y, far, y),
      text("rig-text", left + WALL + body / 2, y - deep / 2 - 8, "Actuator"),
      text("rig-text muted", left + WALL + body / 2, y + deep / 2 + 16, plain(actuator.kind)),
      text("rig-text", far - device * 0.52, y - deep * 0.4 - 8, "Specimen"),
      text("rig-text muted", far - device * 0.52, y + deep / 2 + 16, plain(specimen.kind)),
      this.current,
      this.moving,
      this.force,
      this.words,
      ...this.#ruled(),
      this.command,
      this.measured,
    );
    if (this.index.current >= 0) move(this.current, 0, 16);
    this.say(`Stroke to the scale of the ruler, ± ${significant(this.limit)} ${this.channels[this.index.command].unit} between the limits. The rest of the rig is not to scale.`);
  }

  /** @param {number} x @param {number} y @param {number} tall */
  #wall(x, y, tall) {
    const [top, bottom] = [y - tall / 2, y + tall / 2];
    let hatch = "";
    for (let at = top; at < bottom; at += 9) hatch += `M${x} ${Math.min(bottom, at + 9)}L${x + WALL} ${at}`;
    return svg("g", { class: "wall" }, svg("path", { d: hatch }), svg("rect", { x, y: top, width: WALL, height: bottom - top }));
  }

  /** The ruler: a tick at every fifth of the limit, and the limits as lines. */
  #ruled() {
    const { x, y } = /** @type {{x: number, y: number}} */ (this.ruler);
    const at = (/** @type {number} */ share) => x + share * this.limit * (this.pixels ?? 0);
    const ticks = Array.from({ length: 11 }, (_, k) => (k - 5) / 5);
    return [
      line("ruler", at(-BEYOND), y, at(BEYOND), y),
      ...ticks.map((share) => line("ruler", at(share), y, at(share), y + (share === 0 ? 8 : 5))),
      ...[-1, 1].flatMap((side) => [line("limit", at(side), y - 12, at(side), y + 14), text("rig-text limit-text", at(side), y + 30, `limit ${side < 0 ? "−" : ""}${significant(this.limit)}`)]),
      text("rig-text muted", x, y + 30, "0"),
    ];
  }

  /** @param {Moment} moment @param {Margin[]} _margins @param {boolean} numbers */
  show({ values }, _margins, numbers) {
    const { moving, command, measured, force, ruler, pixels = 0 } = this;
    if (!moving || !ruler || !force) return;
    const place = (/** @type {number} */ index) => (Number.isFinite(values[index]) ? Math.max(-1e3, Math.min(1e3, values[index] * pixels)) : 0);
    const stroke = place(this.index.measured);
    move(moving, stroke);
    move(/** @type {any} */ (measured), ruler.x + stroke, ruler.y);
    move(/** @type {any} */ (command), ruler.x + place(this.index.command), ruler.y);
    const pull = Number.isFinite(values[this.index.force]) ? (60 * values[this.index.force]) / this.forceLimit : 0;
    const back = Math.sign(pull) * Math.min(7, Math.abs(pull));
    change(force.children[0], { x1: stroke, x2: stroke + pull });
    force.children[1].setAttribute("d", Math.abs(pull) < 1 ? "" : `M${(stroke + pull).toFixed(1)} 0l${(-back).toFixed(1)} -4v8z`);
    if (!numbers) return;
    const said = (/** @type {number} */ index, /** @type {number} */ decimals) => `${fixed(values[index], decimals)} ${this.channels[index].unit}`;
    if (this.words) this.words.textContent = said(this.index.force, 1);
    if (this.current && this.index.current >= 0) this.current.textContent = said(this.index.current, 2);
  }
}

/** @param {string} kind */
const plain = (kind) => kind.replaceAll("_", " ");
