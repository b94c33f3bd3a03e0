// @ts-check
import { el } from "../dom.js";
import { number } from "../format.js";
import { kindLabel } from "./schema.js";

/** @typedef {import("./schema.js").Schema} Schema @typedef {import("./field.js").Node} Node */

const PARTS = ["specimen", "actuator", "compensator"];
const LIMITS = ["displacement", "velocity", "force"];

/** The fold of one station: its fields behind a line that says what the station is. */
export class StationFold {
  /** @param {Schema} schema @param {Node} node of a station @param {HTMLElement} fields @param {number} index from 0 @param {boolean} open */
  constructor(schema, node, fields, index, open) {
    this.schema = schema;
    this.node = node;
    this.name = el("span", { class: "fold-name" });
    this.facts = el("span", { class: "fold-facts" });
    const words = [this.name, this.facts, el("span", { class: "fold-state" }), el("span", { class: "fold-trip" })];
    const summary = el("summary", {}, el("span", { class: "fold-number" }, String(index + 1)), ...words);
    this.element = el("details", { class: "fold", "data-station": index, open }, summary, fields);
  }

  /** Show what the station is now. @param {any} station */
  show(station) {
    const { properties } = this.node;
    const place = this.schema.applies(properties.storey) && `Storey ${station.storey}, ${station.dampers} ${station.dampers === 1 ? "damper" : "dampers"}`;
    const parts = PARTS.map((name) => this.#kind(properties[name], station[name]));
    this.name.textContent = station.name || "Station without a name";
    const external = station.connection && station.connection.kind !== "emulated" && `External: ${this.#kind(properties.connection, station.connection)}`;
    this.facts.replaceChildren(...[external, place, ...parts, this.#limits(station.limits)].filter(Boolean).map((text) => el("span", {}, text)));
  }

  /** @param {Node} unresolved @param {any} value */
  #kind(unresolved, value) {
    if (value.kind === "none") return `No ${unresolved.title.toLowerCase()}`;
    const kind = this.schema.kinds(this.schema.resolve(unresolved)).get(value.kind);
    return kind ? kindLabel(kind) : value.kind;
  }

  /** @param {any} limits */
  #limits(limits) {
    const { properties } = this.schema.resolve(this.node.properties.limits);
    const shown = LIMITS.map((name) => {
      const { factor, shown_label } = properties[name];
      return typeof limits[name] === "number" ? `${number(limits[name] / (factor ?? 1), 3)} ${shown_label}` : "–";
    });
    return `Limits ${shown.join(", ")}`;
  }
}

/** Give each fold of a station the number of its errors. @param {HTMLElement} host of the form */
export function countErrors(host) {
  for (const fold of host.querySelectorAll("details.fold")) {
    const count = fold.querySelectorAll("[aria-invalid]").length;
    const state = /** @type {HTMLElement} */ (fold.querySelector(".fold-state"));
    state.textContent = count ? `${count} ${count === 1 ? "error" : "errors"}` : "";
  }
}

/** Open every fold around an element, so that it can be seen and focused. @param {Element} element */
export function unfold(element) {
  for (let fold = element.closest("details"); fold; fold = fold.parentElement?.closest("details") ?? null) fold.open = true;
}

/** Show an element of the form and put the keyboard on it. @param {HTMLElement} element */
export function goTo(element) {
  unfold(element);
  element.focus();
}
