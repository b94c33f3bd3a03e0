// @ts-check
import { el } from "../dom.js";
import { TimeChart } from "./time_chart.js";

/** @typedef {import("./view.js").View} View @typedef {import("./figure.js").Series} Series @typedef {{title: string, unit: string, series: Series[], limit?: number | null}} Strip */

/**
 * Signals against time, one strip below the other on one time axis, with the sentence of a trip beside its mark.
 *
 *     const panel = new TimePanel(host, view);
 *     panel.show(strips);
 */
export class TimePanel {
  visible = true;

  /** @param {HTMLElement} host @param {View} view */
  constructor(host, view) {
    this.view = view;
    /** @type {TimeChart[]} */
    this.charts = [];
    this.sentence = el("p", { class: "trip-note", hidden: true });
    this.strips = el("div", { class: "strips" });
    this.element = el("div", { class: "time-panel" }, this.strips, this.sentence);
    host.replaceChildren(this.element);
    view.add(this.element, this);
  }

  /** Show these strips in place of the present ones. @param {Strip[]} strips */
  show(strips) {
    for (const chart of this.charts) chart.close();
    this.charts = strips.map(({ title, unit, series, limit }, i) => {
      const chart = new TimeChart(this.view, title, unit, series, { limit, bare: i < strips.length - 1 });
      chart.figure.element.classList.add("strip");
      return chart;
    });
    this.strips.replaceChildren(...this.charts.map((chart) => chart.figure.element));
  }

  /** Place the sentence of the trip beside its mark. */
  draw() {
    const { trip } = this.view;
    const [from, to] = this.view.range();
    const over = this.charts[0]?.plot?.over;
    const seen = trip && over && trip.time_s >= from && trip.time_s <= to;
    this.sentence.hidden = !seen;
    if (!seen) return;
    this.sentence.textContent = trip.sentence;
    const panel = this.element.getBoundingClientRect();
    const area = over.getBoundingClientRect();
    const x = area.left - panel.left + ((trip.time_s - from) / (to - from)) * area.width;
    const right = x > panel.width / 2;
    this.sentence.classList.toggle("left-of", right);
    this.sentence.style.left = right ? "auto" : `${x}px`;
    this.sentence.style.right = right ? `${panel.width - x}px` : "auto";
  }

  follow() {
    if (this.view.trip) this.draw();
  }

  readout() {}
}
