// @ts-check
// The capacities of a rig's actuators as rows of fields, in the units that people read; REST has SI.
import { el, htmlElements } from "../dom.js";
import { significant } from "../format.js";

/** @typedef {{name: string, stroke: number | null, velocity: number | null, force: number | null}} Actuator */

/** key -> label with unit, and SI per unit shown */
const QUANTITIES = /** @type {const} */ ({ stroke: ["Stroke, ± mm", 1e-3], velocity: ["Velocity, mm/s", 1e-3], force: ["Force, kN", 1e3] });
const KEYS = /** @type {(keyof typeof QUANTITIES)[]} */ (Object.keys(QUANTITIES));

/** @param {number | null} value @param {keyof typeof QUANTITIES} key */
const shown = (value, key) => (value == null ? "" : significant(value / QUANTITIES[key][1], 6));

/** @param {any} host @param {Actuator} [actuator] */
export function addActuator(host, actuator = { name: "", stroke: null, velocity: null, force: null }) {
  const number = (/** @type {keyof typeof QUANTITIES} */ key) =>
    el("label", {}, QUANTITIES[key][0], el("input", { type: "number", min: "0", step: "any", "data-key": key, value: shown(actuator[key], key) }));
  const row = el(
    "div",
    { class: "fields actuator" },
    el("label", {}, "Name", el("input", { "data-key": "name", maxlength: 80, value: actuator.name, autocomplete: "off" })),
    ...KEYS.map(number),
    el("button", { type: "button", class: "quiet small", on: { click: () => row.remove() } }, "Remove the actuator"),
  );
  host.append(row);
}

/** @param {any} host @returns {Actuator[]} */
export function actuatorsOf(host) {
  return htmlElements(host.children).map((row) => {
    const value = (/** @type {string} */ key) => /** @type {any} */ (row.querySelector(`[data-key="${key}"]`)).value.trim();
    const number = (/** @type {keyof typeof QUANTITIES} */ key) => (value(key) === "" ? null : Number(value(key)) * QUANTITIES[key][1]);
    return { name: value("name"), stroke: number("stroke"), velocity: number("velocity"), force: number("force") };
  });
}

/** An actuator in words. @param {Actuator} actuator @param {number} index */
export function actuatorWords(actuator, index) {
  const units = { stroke: "mm", velocity: "mm/s", force: "kN" };
  const known = KEYS.map((key) => (actuator[key] == null ? "–" : `${shown(actuator[key], key)} ${units[key]}`));
  return `${actuator.name || `Actuator ${index + 1}`}: ${known.join(", ")}`;
}
