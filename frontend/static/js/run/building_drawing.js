// @ts-check
import { fixed, number } from "../format.js";
import { columns, fitted, magnification, storeys } from "./building.js";
import { StationDrawing } from "./station_drawing.js";
import { change, hatched, line, move, svg, text } from "./svg.js";

/** @typedef {import("./store.js").Channel} Channel @typedef {import("./store.js").Moment} Moment @typedef {import("./margin.js").Margin} Margin */

const LABEL = 30; // pixels between two labelled floors, at least
const SLAB = 7;
const GROUND = 44; // pixels below the ground line: hatching, arrow and value of the ground acceleration
const LABELS = 132; // pixels right of the building
const ARROW = 46; // pixels of the largest arrow

/** A building with its stations: floors move relative to the ground, at a magnification that the caption states. */
export class BuildingDrawing {
  /** @param {any} plan */
  static named(plan) {
    const floors = plan.structure.storeys?.length ?? plan.structure.floors?.length;
    return `Drawing of the building${floors ? ` of ${floors} ${floors === 1 ? "storey" : "storeys"}` : ""}, its floors moving relative to the ground. Gauges and charts show the same values as numbers.`;
  }

  /** @param {SVGElement} root @param {any} plan @param {Channel[]} channels @param {(words: string) => void} say */
  constructor(root, plan, channels, say) {
    this.root = root;
    this.plan = plan;
    this.say = say;
    const of = (/** @type {string} */ role) => channels.flatMap((one, index) => (one.role === role ? [{ index, ...one }] : []));
    this.floors = of("x_floor");
    this.ground = plan.motion.kind === "none" ? null : (of("ag")[0] ?? null);
    this.pushes = of("force_ext");
    const { heights, known } = storeys(plan.structure, this.floors.length);
    this.heights = heights;
    this.total = heights.reduce((sum, one) => sum + one, 0);
    this.known = known;
    this.factor = this.floors[0]?.factor ?? 1e-3;
    this.times = 0; // no magnification yet
    this.room = 0;
    this.scale = 1;
    /** @type {import("./building.js").Frame | null} */
    this.frame = null;
    /** @type {SVGElement[]} */
    this.reach = [];
    /** @type {SVGElement[]} */
    this.slabs = [];
    /** @type {any[]} */
    this.labels = [];
    /** @type {SVGGElement[]} */
    this.arrows = [];
    /** @type {StationDrawing[]} */
    this.stations = [];
  }

  /** @param {number} width @param {number} height */
  build(width, height) {
    const room = Math.min(0.11 * width, 90);
    const right = width - LABELS;
    const box = { left: 12 + room, right: right - room, top: 18, bottom: height - GROUND };
    const bays = this.plan.structure.bays ?? [];
    this.frame = fitted(this.heights, bays, box);
    this.room = room;
    this.scale = (box.bottom - box.top) / this.total;
    this.times = 0;
    const { levels, lines, left, right: end } = this.frame;
    this.columns = svg("path", { class: "columns" });
    this.reach = this.floors.map((_, k) => line("reach", 0, levels[k + 1], 0, levels[k + 1]));
    this.slabs = this.floors.map((_, k) => svg("rect", { class: "slab", x: left - 4, y: levels[k + 1] - SLAB / 2, width: end - left + 8, height: SLAB }));
    const every = Math.max(1, Math.ceil((LABEL * this.floors.length) / (box.bottom - box.top)));
    this.labels = this.floors.map((_, k) => ((this.floors.length - 1 - k) % every === 0 ? this.#label(k, width, levels[k + 1]) : null));
    this.stations = this.#stations();
    const rest = `M${lines.map((x) => `${x} ${levels[0]}V${levels.at(-1)}`).join("M")}${levels.slice(1).map((y) => `M${left} ${y}H${end}`).join("")}`;
    this.arrows = this.pushes.map(({ number: floor }) => svg("g", {}, line("force", 0, levels[floor ?? 0], 0, levels[floor ?? 0]), svg("path", { class: "force-head" })));
    this.quake = svg("g", { class: "quake" }, line("force", 0, 0, 0, 0), svg("path", { class: "force-head" }));
    move(this.quake, (left + end) / 2, levels[0] + 24);
    this.quakeText = text("quake-text", (left + end) / 2, levels[0] + 40, "");
    this.root.replaceChildren(
      svg("path", { class: "ground", d: hatched(left - room * 0.6, end + room * 0.6, levels[0]) }),
      svg("path", { class: "rest", d: rest }),
      ...this.reach,
      this.columns,
      ...this.stations.map((one) => one.element),
      ...this.slabs,
      ...this.arrows,
      ...(this.ground ? [this.quake, this.quakeText] : []),
      ...this.labels.flatMap((one) => (one ? [one.element] : [])),
      ...this.stations.map((one) => one.badge),
    );
  }

  /** @param {number} k @param {number} width @param {number} y */
  #label(k, width, y) {
    const value = svg("tspan", { class: "floor-value" });
    const peak = text("floor-peak", width - 4, y + 12, "");
    const element = svg("g", {}, text("floor-name", width - LABELS + 10, y - 1, `Floor ${k + 1}`), svg("text", { class: "floor-now", x: width - 4, y: y - 1 }, value, ` ${this.floors[k].unit}`), peak);
    return { element, value, peak };
  }

  #stations() {
    const frame = /** @type {import("./building.js").Frame} */ (this.frame);
    const { stations } = this.plan;
    const drawn = (/** @type {any} */ station) => Math.min(station.storey, this.heights.length); // matrices can have more strokes than floors
    const beside = (/** @type {number} */ storey) => stations.filter((/** @type {any} */ one) => drawn(one) === storey).length;
    /** @type {Map<number, number>} */
    const seen = new Map();
    return stations.map((/** @type {any} */ station, /** @type {number} */ i) => {
      const storey = drawn(station);
      const order = seen.get(storey) ?? 0;
      seen.set(storey, order + 1);
      return new StationDrawing(frame, storey, i + 1, order, beside(storey));
    });
  }

  /** @param {Moment} moment @param {Margin[]} margins @param {boolean} numbers */
  show({ values, lowest, highest }, margins, numbers) {
    const { frame, columns: drawn } = this;
    if (!frame || !drawn) return;
    this.#magnify(lowest, highest);
    const pixels = this.factor * this.scale * this.times;
    const moved = [0, ...this.floors.map(({ index }) => (Number.isFinite(values[index]) ? Math.max(-9e3, Math.min(9e3, values[index] * pixels)) : 0))];
    drawn.setAttribute("d", columns(frame, moved));
    this.slabs.forEach((slab, k) => move(slab, moved[k + 1]));
    this.stations.forEach((station, i) => station.show(moved, margins[i]));
    this.#forces(values, moved, lowest, highest);
    if (!numbers) return;
    this.floors.forEach(({ index }, k) => {
      const covered = lowest[index] <= highest[index];
      if (covered) change(this.reach[k], { x1: frame.right + lowest[index] * pixels, x2: frame.right + highest[index] * pixels });
      const label = this.labels[k];
      if (!label) return;
      label.value.textContent = fixed(values[index], 1);
      label.peak.textContent = covered ? `peak ${fixed(Math.max(-lowest[index], highest[index]), 1)} ${this.floors[k].unit}` : "";
    });
  }

  /** Lower the magnification when the floors would leave the drawing; it never rises during a test. @param {Float32Array} lowest @param {Float32Array} highest */
  #magnify(lowest, highest) {
    const peak = this.floors.reduce((most, { index }) => Math.max(most, -lowest[index], highest[index]), 0);
    const wanted = magnification(this.room, Math.max(peak, this.#least()) * this.factor, this.scale);
    if (this.times && wanted >= this.times) return;
    this.times = wanted;
    const height = this.known ? `Storey heights to scale, ${number(this.total, 3)} m in all; widths are not.` : "The plan states no storey heights: they are drawn equal.";
    this.say(`Floor displacement relative to the ground × ${wanted < 1 ? number(wanted, 2) : wanted}. ${height}`);
  }

  /** The displacement for which the drawing has room from the start: a tenth of the smallest stroke limit, or 10 mm. */
  #least() {
    const strokes = this.plan.stations.map((/** @type {any} */ { limits }) => limits.displacement / this.factor / 10);
    return Math.min(10e-3 / this.factor, ...strokes);
  }

  /** Arrows of the forces on floors and of the ground acceleration. @param {Float32Array} values @param {number[]} moved @param {Float32Array} lowest @param {Float32Array} highest */
  #forces(values, moved, lowest, highest) {
    const { levels, left } = /** @type {import("./building.js").Frame} */ (this.frame);
    const share = (/** @type {number} */ index) => values[index] / (Math.max(-lowest[index], highest[index]) || 1);
    this.pushes.forEach(({ index, number: floor }, i) => {
      const [y, base] = [levels[floor ?? 0], left - 8 + moved[floor ?? 0]];
      const long = ARROW * share(index);
      arrow(this.arrows[i], long > 0 ? base - long : base, y, long);
    });
    if (!this.ground || !this.quake) return;
    arrow(this.quake, 0, 0, ARROW * share(this.ground.index));
    if (this.quakeText) this.quakeText.textContent = `ground acceleration ${fixed(values[this.ground.index], 3)} ${this.ground.unit}`;
  }
}

/** Draw an arrow from x along its length, to the left if it is negative. @param {SVGGElement} group @param {number} x @param {number} y @param {number} long */
function arrow(group, x, y, long) {
  const [shaft, head] = group.children;
  const found = Number.isFinite(long) ? long : 0;
  change(shaft, { x1: x.toFixed(1), x2: (x + found).toFixed(1), y1: y, y2: y });
  const back = Math.sign(found) * Math.min(6, Math.abs(found));
  head.setAttribute("d", Math.abs(found) < 1 ? "" : `M${(x + found).toFixed(1)} ${y}l${(-back).toFixed(1)} -4v8z`);
}
