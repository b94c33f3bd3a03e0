// @ts-check
import { el } from "../dom.js";
import { reading } from "../format.js";

/** @typedef {{index: number, label: string, unit: string, colour: string, width?: number, dash?: number[]}} Series */

const KEYS = "Arrow keys move the cursor. Plus and minus zoom. Escape shows the whole test.";

/** A figure: its heading, the name and value of each series, and a box for the plot with keyboard control. */
export class Figure {
  /** @param {string} title @param {string} unit @param {Series[]} series @param {boolean} keys whether the plot takes keys */
  constructor(title, unit, series, keys) {
    this.title = title;
    this.unit = unit;
    this.series = series;
    this.keys = keys;
    this.values = series.map(() => el("output", { class: "value", "aria-live": "off" }, "–"));
    const entries = series.map((one, i) =>
      el("span", { class: one.label ? "entry" : "entry alone" }, keys && one.label && el("span", { class: `swatch ${one.colour.slice(2)}${one.dash ? " dashed" : ""}` }), `${one.label} `, this.values[i], one.unit && ` ${one.unit}`),
    );
    this.at = el("span", { class: "at muted" });
    this.entries = el("div", { class: "values" }, ...entries);
    this.plot = el("div", { class: "plot", role: "img", tabindex: "0", "aria-label": this.describe("no data yet") });
    this.element = el(
      "figure",
      { class: "chart" },
      el("figcaption", {}, el("strong", {}, unit ? `${title}, ${unit}` : title), this.at),
      this.entries,
      this.plot,
    );
  }

  /** Add words below the values, such as a limit. @param {string} words */
  note(words) {
    this.entries.append(el("span", { class: "figure-note muted" }, words));
  }

  /** Show values and update the plot's description for screen readers. @param {number | null} time @param {number[]} values @param {boolean} atCursor */
  show(time, values, atCursor) {
    values.forEach((value, i) => (this.values[i].textContent = reading(value)));
    this.at.textContent = atCursor && time !== null ? `at ${time.toFixed(3)} s` : "";
    const said = this.series.map((one, i) => `${one.label} ${reading(values[i])} ${one.unit}`.trim()).join(", ");
    const when = time === null ? "no data yet" : `at ${time.toFixed(2)} s: ${said}`;
    this.plot.setAttribute("aria-label", this.describe(when));
  }

  /** @param {string} when */
  describe(when) {
    return `${this.title}, ${when}. ${this.keys ? KEYS : ""}`;
  }
}
