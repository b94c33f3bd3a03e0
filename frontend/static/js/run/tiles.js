// @ts-check
import { el } from "../dom.js";
import { fixed } from "../format.js";
import { meaning, of } from "./measures.js";

/** @typedef {import("./measures.js").Measure} Measure */

/** The measures beside the charts: one list for each station and one for the structure. During a test they show the values so far. */
export class Tiles {
  /** @param {any} plan @param {Measure[]} measures */
  constructor(plan, measures) {
    this.stations = plan.stations.map(() => new List(of(measures, "station", plan.test)));
    this.structure = new List(of(measures, "run", plan.test));
  }

  /** Show the measures of a run, or of a running test so far. @param {{stations: any[]} & Record<string, any>} measures */
  show(measures) {
    measures.stations.forEach((station, i) => this.stations[i]?.show(station));
    this.structure.show(measures);
  }

  /** Hide the measures of the stations: after the test, tables show them. */
  fold() {
    this.stations.forEach((/** @type {List} */ list) => (list.element.hidden = true));
  }
}

class List {
  /** @param {Measure[]} measures */
  constructor(measures) {
    this.measures = measures;
    this.values = measures.map(() => el("span", { class: "value" }, "–"));
    const tiles = measures.map((one, i) =>
      el("div", { title: meaning(one) }, el("dt", {}, one.label), el("dd", {}, this.values[i], one.shown_label && ` ${one.shown_label}`)),
    );
    this.element = el("dl", { class: "tiles" }, ...tiles);
  }

  /** @param {Record<string, any>} found */
  show(found) {
    this.measures.forEach(({ key, decimals }, i) => (this.values[i].textContent = fixed(found[key], decimals)));
  }
}
