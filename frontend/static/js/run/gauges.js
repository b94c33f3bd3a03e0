// @ts-check
import { el } from "../dom.js";
import { Gauge } from "./gauge.js";
import { limited, tripped } from "./limits.js";
import { smallest } from "./margin.js";

/** @typedef {import("./store.js").Channel} Channel @typedef {import("./store.js").Moment} Moment @typedef {import("./margin.js").Margin} Margin */

/** Most stations of each size of gauges: large ones; a line each; a line each in a column of full height; beyond, a thin line each. */
const SIZES = [
  [2, "few"],
  [4, "several"],
  [12, "several tall"],
  [Infinity, "many tall"],
];

/**
 * The gauges of all stations: stroke, velocity and force of each against its safety limits. With several stations each row is the
 * radio button that selects the station whose loop and signals are shown.
 *
 *     const gauges = new Gauges(host, plan, channels, (station) => …);
 *     gauges.show(store.moment());
 */
export class Gauges {
  /** @param {HTMLElement} host @param {any} plan @param {Channel[]} channels of the live schema @param {((station: number) => void) | null} [select] */
  constructor(host, plan, channels, select = null) {
    this.channels = channels;
    /** @type {any} the trip that ended the run */
    this.trip = null;
    this.quantities = plan.stations.map((/** @type {any} */ _, /** @type {number} */ i) => limited(plan, channels, i));
    this.gauges = this.quantities.map((/** @type {any[]} */ some) => some.map(({ label, unit, limit }) => new Gauge(label, unit, limit)));
    const count = plan.stations.length;
    const size = SIZES.find(([most]) => count <= most)?.[1];
    const rows = plan.stations.map((/** @type {any} */ station, /** @type {number} */ i) => row(station, i, count, plan.test, this.gauges[i], select));
    this.element = el("div", { class: `stations ${size}`, ...(select && count > 1 ? { role: "radiogroup", "aria-label": "Station shown" } : {}) }, ...rows);
    host.replaceChildren(this.element);
  }

  /** Show a moment; returns the margin of each station. @param {Moment} moment @param {boolean} [numbers] whether the numbers change too @returns {Margin[]} */
  show(moment, numbers = true) {
    return this.gauges.map((/** @type {Gauge[]} */ gauges, /** @type {number} */ station) =>
      smallest(
        gauges.map((gauge, k) => {
          const { index } = this.quantities[station][k];
          const beyond = tripped(this.trip, station, k, this.channels[index].factor);
          return gauge.show(moment.values[index], moment.lowest[index], moment.highest[index], beyond, numbers);
        }),
      ),
    );
  }
}

/** @param {any} station @param {number} i @param {number} count @param {string} test @param {Gauge[]} gauges @param {((station: number) => void) | null} select */
function row(station, i, count, test, gauges, select) {
  const chosen = select && count > 1;
  const radio = chosen && el("input", { type: "radio", name: "station", value: i, checked: i === 0, "aria-label": `Station ${i + 1}: ${station.name}`, on: { change: () => select(i) } });
  const place = test === "hybrid" ? `storey ${station.storey}, ${station.dampers} ${station.dampers === 1 ? "damper" : "dampers"}` : "";
  return el(
    chosen ? "label" : "div",
    { class: "station" },
    radio,
    el("span", { class: "station-name" }, el("span", { class: "station-number" }, String(i + 1)), el("span", { class: "station-words" }, el("strong", {}, station.name), place && el("span", { class: "station-place" }, place))),
    el("span", { class: "station-gauges" }, ...gauges.map((gauge) => gauge.element)),
  );
}
