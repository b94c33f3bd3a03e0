// @ts-check
import { el } from "../dom.js";
import { Gauge } from "./gauge.js";

/** @typedef {import("./store.js").Channel} Channel @typedef {import("./store.js").Moment} Moment */

const MOST = 12;

/** The displacement of each floor of a test without stations, all on one scale: its present value and the range that it has covered. At most twelve floors are shown, the top floor first. */
export class FloorGauges {
  /** @param {HTMLElement} host @param {Channel[]} channels */
  constructor(host, channels) {
    const floors = channels.flatMap(({ role, number, unit }, index) => (role === "x_floor" ? [{ index, number, unit }] : []));
    const count = Math.min(floors.length, MOST);
    const some = Array.from({ length: count }, (_, i) => floors[Math.round(((i + 1) * floors.length) / count) - 1]);
    this.floors = some.reverse().map(({ index, number, unit }) => ({ index, gauge: new Gauge(`Floor ${number}`, unit, null) }));
    this.element = el("div", { class: "stations floors" }, ...this.floors.map(({ gauge }) => gauge.element));
    host.replaceChildren(this.element);
  }

  /** @param {Moment} moment @param {boolean} [numbers] whether the numbers change too */
  show({ values, lowest, highest }, numbers = true) {
    const scale = Math.max(...this.floors.map(({ index }) => Math.max(-lowest[index], highest[index])));
    for (const { index, gauge } of this.floors) {
      gauge.scale = scale > 0 && scale < Infinity ? scale : 1;
      gauge.show(values[index], lowest[index], highest[index], null, numbers);
    }
    return [];
  }
}
