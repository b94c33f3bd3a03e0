// @ts-check
import { byId, el } from "../dom.js";
import { brief, digits } from "./results.js";

/** @typedef {import("./results.js").Results} Results */

const PAGE = 50;

/** The points in a table: sorted by a column, filtered, a page at a time. */
export class PointTable {
  measure = "";
  page = 0;

  /** @param {Results} results @param {(row: number) => void} choose @param {() => void} filtered */
  constructor(results, choose, filtered) {
    this.results = results;
    this.choose = choose;
    this.filtered = filtered;
    byId("all-columns").addEventListener("change", () => this.draw(this.measure));
    byId("status").addEventListener("change", () => {
      results.status = byId("status").value;
      filtered();
    });
    byId("before").addEventListener("click", () => this.#turn(-1));
    byId("after").addEventListener("click", () => this.#turn(1));
  }

  /** @param {number} pages */
  #turn(pages) {
    this.page += pages;
    this.draw(this.measure);
  }

  /** The columns that are shown: all, or inputs, intensity, status and the chosen measure of every station and floor. */
  #columns() {
    const all = byId("all-columns").checked;
    const { measure } = this.results.column(this.measure);
    const shown = this.results.columns.filter((one) => all || one.role === "input" || one.key === "status" || ["pga_g", "sa_t1_g"].includes(one.key) || (one.measure && one.measure === measure));
    return shown.sort((a, b) => Number(b.key === "status") - Number(a.key === "status"));
  }

  /** @param {string} measure */
  draw(measure) {
    this.measure = measure;
    const { results } = this;
    const rows = results.rows();
    const pages = Math.max(1, Math.ceil(rows.length / PAGE));
    this.page = Math.min(Math.max(0, this.page), pages - 1);
    const columns = this.#columns();
    const shown = rows.slice(this.page * PAGE, (this.page + 1) * PAGE);
    const head = el("tr", {}, el("th", { scope: "col" }, el("span", { class: "unseen" }, "Choose")), this.#heading("point", "Point"), ...columns.map((one) => this.#heading(one.key, brief(one), !one.categories.length)), el("th", { scope: "col" }, "Reason"));
    byId("points").replaceChildren(el("thead", {}, head), el("tbody", {}, ...shown.map((row) => this.#row(row, columns))));
    const span = rows.length ? `${this.page * PAGE + 1} to ${this.page * PAGE + shown.length} of ${rows.length}` : "No point passes the filters.";
    byId("page").textContent = span;
    byId("before").disabled = this.page === 0;
    byId("after").disabled = this.page >= pages - 1;
    byId("count").textContent = rows.length === results.size ? `${rows.length} points` : `${rows.length} of ${results.size} points`;
    byId("filters").replaceChildren(...[...results.ranges].map(([key, ends]) => this.#filter(key, ends)));
  }

  /** @param {string} key @param {[number, number]} ends */
  #filter(key, ends) {
    const drop = () => {
      this.results.ranges.delete(key);
      this.filtered();
    };
    const column = this.results.column(key);
    return el("button", { type: "button", class: "quiet small", on: { click: drop } }, `${column.label}: ${ends.map((one) => digits(one)).join(" to ")} ${column.shown_label}, remove filter`);
  }

  /** @param {string} key @param {string} label @param {boolean} [number] */
  #heading(key, label, number = true) {
    const { results } = this;
    const active = results.sort === key;
    const sort = () => {
      results.descending = active ? !results.descending : false;
      results.sort = key;
      this.page = 0;
      this.draw(this.measure);
    };
    const arrow = active ? (results.descending ? " ▼" : " ▲") : "";
    return el("th", { scope: "col", class: number && "number", "aria-sort": active && (results.descending ? "descending" : "ascending") }, el("button", { type: "button", class: "sort", on: { click: sort } }, label, arrow));
  }

  /** @param {number} row @param {import("./results.js").Column[]} columns */
  #row(row, columns) {
    const { values } = this.results;
    const cell = (/** @type {any} */ { key, categories }) => {
      const value = values[key][row];
      if (key === "status") return el("td", {}, el("span", { class: `badge ${value}` }, String(value)));
      return el("td", { class: categories.length ? "" : "number" }, digits(value));
    };
    const point = values.point[row];
    const choose = el("button", { type: "button", class: "quiet small", "aria-label": `Choose point ${point}`, on: { click: () => this.choose(row) } }, "Choose");
    return el("tr", {}, el("td", {}, choose), el("th", { scope: "row", class: "number" }, String(point)), ...columns.map(cell), el("td", { class: "reason", title: values.reason[row] ?? "" }, String(values.reason[row] ?? "")));
  }
}
