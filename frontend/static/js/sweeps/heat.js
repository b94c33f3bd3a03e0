// @ts-check
import { byId, colour, el } from "../dom.js";
import { colourScale, plot, title } from "./plotting.js";
import { brief, digits, titled } from "./results.js";

/** @typedef {import("./results.js").Results} Results */

const FEW = 3; // values, below which an input is not proposed first
const MOST_LEVELS = 60; // of an axis whose points are drawn as cells

/** The measure over two inputs: cells with the mean where the inputs have few values, else a mark for each point. */
export class HeatMap {
  /** @param {Results} results @param {(row: number) => void} choose */
  constructor(results, choose) {
    this.results = results;
    this.choose = choose;
    for (const id of ["heat-x", "heat-y"]) byId(id).addEventListener("change", () => this.draw(this.measure));
    this.measure = "";
  }

  /** Offer the inputs that vary. */
  #offer() {
    const { results } = this;
    const varied = results.columns.filter(({ key, role }) => role === "input" && new Set(results.values[key]).size > 1);
    const intensities = results.numbers("intensity").filter(({ key }) => new Set(results.values[key]).size > 1);
    const few = (/** @type {{key: string}} */ { key }) => Number(new Set(results.values[key]).size < FEW);
    const offered = [...varied.sort((a, b) => few(a) - few(b)), ...intensities];
    for (const [k, id] of ["heat-x", "heat-y"].entries()) {
      const box = byId(id);
      const kept = box.value;
      box.replaceChildren(...offered.map((one) => el("option", { value: one.key }, one.label)));
      box.value = offered.some(({ key }) => key === kept) ? kept : (offered[Math.min(k, offered.length - 1)]?.key ?? "");
    }
    return offered.length;
  }

  /** @param {string} measure */
  draw(measure) {
    this.measure = measure;
    const { results } = this;
    const offered = this.#offer();
    const column = results.column(measure);
    byId("heat-title").textContent = `Heat map: ${titled(column)}`;
    const trips = results.rows().filter((row) => results.values.status[row] === "tripped").length;
    byId("heat-words").textContent = trips ? `${trips} tripped points count with their values until the trip; the filter of the status leaves them out.` : "";
    if (!offered) return plot(byId("heat"), [], { annotations: [said("No input varies among the points so far.")] });
    const [x, y] = [byId("heat-x").value, byId("heat-y").value].map((key) => results.column(key));
    const rows = results.rows().filter((row) => Number.isFinite(results.number(measure, row)));
    const levels = [x, y].map(({ key }) => [...new Set(rows.map((row) => results.number(key, row)))].sort((a, b) => a - b));
    const cells = x.key !== y.key && levels.every((some) => some.length <= MOST_LEVELS) && levels[0].length * levels[1].length <= 4 * rows.length;
    if (x.key === y.key) this.#line(column, x, rows);
    else if (cells) this.#cells(column, x, y, levels, rows);
    else this.#marks(column, x, y, rows);
  }

  /** The measure over the one input that varies. @param {any} column @param {any} x @param {number[]} rows */
  #line(column, x, rows) {
    const { results } = this;
    byId("heat-title").textContent = `${titled(column)} over ${brief(x)}`;
    const sorted = [...rows].sort((a, b) => results.number(x.key, a) - results.number(x.key, b));
    const trace = {
      type: "scatter",
      mode: "lines+markers",
      x: sorted.map((row) => results.number(x.key, row)),
      y: sorted.map((row) => results.number(column.key, row)),
      text: sorted.map((row) => `point ${results.values.point[row]}`),
      line: { color: colour("--curve-1"), width: 1.5 },
      marker: { color: colour("--curve-1"), size: 7 },
      hovertemplate: "%{text}<br>%{x}: %{y:.3g}<extra></extra>",
    };
    plot(byId("heat"), [trace], { hovermode: "closest", xaxis: title(titled(x)), yaxis: title(titled(column)) });
  }

  /** @param {any} column @param {any} x @param {any} y @param {number[][]} levels @param {number[]} rows */
  #cells(column, x, y, levels, rows) {
    const { results } = this;
    /** @type {number[][][]} */
    const inside = levels[1].map(() => levels[0].map(() => []));
    for (const row of rows) inside[levels[1].indexOf(results.number(y.key, row))][levels[0].indexOf(results.number(x.key, row))].push(row);
    const mean = (/** @type {number[]} */ some) => (some.length ? some.reduce((sum, row) => sum + results.number(column.key, row), 0) / some.length : null);
    const texts = [x, y].map((axis, k) => levels[k].map((level) => (axis.categories.length ? axis.categories[level] : digits(level))));
    const trace = {
      type: "heatmap",
      x: texts[0],
      y: texts[1],
      z: inside.map((line) => line.map(mean)),
      text: inside.map((line) => line.map((some) => `${digits(mean(some))} ${column.shown_label}, ${some.length === 1 ? `point ${results.values.point[some[0]]}` : `mean of ${some.length} points`}`)),
      hovertemplate: `%{text}<br>${brief(x)}: %{x}<br>${brief(y)}: %{y}<extra></extra>`,
      hoverongaps: false,
      xgap: 1,
      ygap: 1,
      colorscale: colourScale(),
      colorbar: bar(column),
    };
    const axes = { xaxis: { ...title(brief(x)), type: "category" }, yaxis: { ...title(brief(y)), type: "category" } };
    plot(byId("heat"), [trace], axes, (at) => {
      const [first] = inside[at.pointIndex[0]][at.pointIndex[1]];
      if (first !== undefined) this.choose(first);
    });
  }

  /** @param {any} column @param {any} x @param {any} y @param {number[]} rows */
  #marks(column, x, y, rows) {
    const { results } = this;
    const of = (/** @type {any} */ axis) => rows.map((row) => results.values[axis.key][row]);
    const trace = {
      type: "scatter",
      mode: "markers",
      x: of(x),
      y: of(y),
      marker: { size: 8, color: rows.map((row) => results.number(column.key, row)), colorscale: colourScale(), showscale: true, colorbar: bar(column) },
      text: rows.map((row) => `point ${results.values.point[row]}: ${digits(results.values[column.key][row])} ${column.shown_label}`),
      hovertemplate: "%{text}<extra></extra>",
    };
    plot(byId("heat"), [trace], { hovermode: "closest", xaxis: title(brief(x)), yaxis: title(brief(y)) }, (at) => this.choose(rows[at.pointIndex]));
  }
}

/** @param {any} column */
const bar = (column) => ({ title: { text: titled(column), side: "right" }, thickness: 12, outlinewidth: 0 });

/** A sentence in the middle of an empty plot. @param {string} text */
export const said = (text) => ({ text, showarrow: false, xref: "paper", yref: "paper", x: 0.5, y: 0.5 });
