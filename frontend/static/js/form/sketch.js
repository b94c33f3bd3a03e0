// @ts-check
import { smallest } from "../run/margin.js";
import { Schematic } from "../run/schematic.js";
import { marginOf } from "./peaks.js";

/** @typedef {import("../run/store.js").Channel} Channel */

const TESTED = ["x_cmd", "x_meas", "f_meas"];

/** The sketch of the plan in the form: the drawing of the live page at rest, with the peaks and margins of the dry run. */
export class Sketch {
  /** @param {HTMLElement} host @param {Record<string, any>} roles channels of the schema of plans */
  constructor(host, roles) {
    this.host = host;
    this.roles = roles;
    this.shown = "";
    /** @type {Schematic | null} */
    this.schematic = null;
    /** @type {Channel[]} */
    this.channels = [];
  }

  /** Draw a valid plan. @param {any} plan */
  draw(plan) {
    const { structure, stations, motion, forces } = plan;
    const shown = JSON.stringify([structure, stations.map((/** @type {any} */ one) => [one.storey, one.limits, one.actuator.kind, one.specimen.kind, one.controller.kind, one.name]), motion.kind, forces.map((/** @type {any} */ one) => one.floor)]);
    if (shown === this.shown) return;
    this.shown = shown;
    this.channels = this.#channels(plan);
    this.schematic = new Schematic(this.host, plan, this.channels);
    this.foresee(null);
  }

  /** Show the peaks of the floors and the margins of the stations. @param {any | null} found preflight */
  foresee(found) {
    if (!this.schematic) return;
    const peaks = found?.floors.find((/** @type {any} */ one) => one.shown_label === "mm")?.values ?? [];
    const values = new Float32Array(this.channels.length);
    const peak = (/** @type {Channel} */ { role, number }) => (role === "x_floor" ? (peaks[(number ?? 1) - 1] ?? 0) : 0);
    const highest = Float32Array.from(this.channels, peak);
    const lowest = highest.map((value) => -value);
    const stations = new Set((found?.uses ?? []).map((/** @type {any} */ use) => use.station));
    const margins = [...stations].map((station) => smallest(found.uses.filter((/** @type {any} */ use) => use.station === station && use.against === "limit").map(marginOf)));
    this.schematic.show({ time: null, values, lowest, highest }, margins);
  }

  /** The channels of a run of the plan, as far as the drawing uses them. @param {any} plan @returns {Channel[]} */
  #channels({ structure, motion, stations, forces }) {
    const channel = (/** @type {string} */ role, /** @type {number | null} */ number = null) => ({ key: number ? `${role}.${number}` : role, role, number, label: "", unit: this.roles[role].shown_label, factor: this.roles[role].factor });
    const tested = stations.flatMap((/** @type {any} */ one, /** @type {number} */ i) => [...TESTED, ...(one.controller.kind === "none" ? [] : ["current"])].map((role) => channel(role, i + 1)));
    if (structure.kind === "none") return tested;
    const floors = [structure.storeys, structure.floors, structure.mass].find((one) => one?.length)?.length ?? 0;
    const pushed = [...new Set(forces.map((/** @type {any} */ one) => one.floor))];
    return [...(motion.kind === "none" ? [] : [channel("ag")]), ...pushed.map((floor) => channel("force_ext", floor)), ...Array.from({ length: floors }, (_, k) => channel("x_floor", k + 1)), ...tested];
  }
}
