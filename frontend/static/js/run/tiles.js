// @ts-check
import { el } from "../dom.js";
import { fixed } from "../format.js";
import { BEYOND, INPUT_ENERGY, PAPERS, telling } from "./measures.js";

/** @typedef {import("./measures.js").Measure} Measure */

/** The measures beside the charts, those so far while the test runs: a list for each station and one for the structure. */
export class Tiles {
  /** @param {any} plan */
  constructor(plan) {
    /** @type {List[]} */
    this.stations = plan.stations.map(() => new List(telling([...PAPERS, ...BEYOND], plan.test)));
    this.structure = new List([INPUT_ENERGY]);
  }

  /** @param {{stations: any[], input_energy_kNm: number | null}} measures */
  show(measures) {
    measures.stations.forEach((station, i) => this.stations[i]?.show(station));
    this.structure.show(measures);
  }

  /** Of an ended run the stations' measures stand in tables. */
  fold() {
    this.stations.forEach((list) => (list.element.hidden = true));
  }
}

class List {
  /** @param {Measure[]} measures */
  constructor(measures) {
    this.measures = measures;
    this.values = measures.map(() => el("span", { class: "value" }, "–"));
    const tiles = measures.map(({ label, unit, long }, i) =>
      el("div", { title: long }, el("dt", {}, label), el("dd", {}, this.values[i], unit && ` ${unit}`)),
    );
    this.element = el("dl", { class: "tiles" }, ...tiles);
  }

  /** @param {Record<string, any>} found */
  show(found) {
    this.measures.forEach(({ key, decimals }, i) => (this.values[i].textContent = fixed(found[key], decimals)));
  }
}
