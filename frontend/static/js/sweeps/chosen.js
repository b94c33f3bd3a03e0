// @ts-check
import { api, explain } from "../api.js";
import { byId, el } from "../dom.js";
import { person } from "../person.js";
import { digits, titled } from "./results.js";

/** @typedef {import("./results.js").Results} Results */

const MOST = 20; // items of a comparison

/** The chosen points beside each other, each with the run of its full recording once it was queued. */
export class Chosen {
  /** number of each chosen point -> its run @type {Map<number, {id: string, number: number} | null>} */
  points = new Map();

  /** @param {string} sweep @param {Results} results */
  constructor(sweep, results) {
    this.sweep = sweep;
    this.results = results;
  }

  /** Choose a point, or show it where it is chosen already. @param {number} row */
  add(row) {
    const point = Number(this.results.values.point[row]);
    if (!this.points.has(point) && this.points.size < MOST) this.points.set(point, null);
    this.draw();
    byId("chosen-part").scrollIntoView({ block: "nearest" });
  }

  draw() {
    const { results, points } = this;
    byId("chosen-part").hidden = !points.size;
    if (!points.size) return;
    const rows = [...points.keys()].map((point) => results.values.point.indexOf(point));
    const columns = results.columns.filter(({ key }) => rows.some((row) => results.values[key][row] !== null));
    const heads = [...points].map(([point, run]) => el("th", { scope: "col" }, `Point ${point}`, el("div", { class: "actions" }, this.#recorded(point, run), this.#remove(point))));
    const body = columns.map((one) => el("tr", {}, el("th", { scope: "row", class: "fixed" }, titled(one)), ...rows.map((row) => el("td", {}, digits(results.values[one.key][row])))));
    const runs = [...points.values()].filter((run) => run !== null);
    const compare = runs.length > 1 && el("a", { class: "button", href: `/compare?items=${runs.map((run) => `run:${run?.id}`).join(",")}` }, `Compare the ${runs.length} runs`);
    byId("chosen").replaceChildren(
      el("div", { class: "scroll", tabindex: "0", role: "region", "aria-label": "Values of the chosen points" }, el("table", { class: "chosen" }, el("thead", {}, el("tr", {}, el("th", { scope: "col", class: "fixed" }, "Column"), ...heads)), el("tbody", {}, ...body))),
      el("p", { class: "actions" }, compare || el("span", { class: "muted", "data-needs": "engineer" }, "Run two points with full recording to compare their signals.")),
      el("p", { id: "chosen-refusal", class: "note bad", role: "alert" }),
    );
  }

  /** @param {number} point @param {{id: string, number: number} | null} run */
  #recorded(point, run) {
    if (run) return el("a", { href: `/runs/${run.id}` }, `Run ${run.number}`);
    const button = el("button", { type: "button", class: "small", "data-needs": "engineer", "aria-label": `Run point ${point} with full recording`, on: { click: () => this.#run(point, button) } }, "Run with full recording");
    return button;
  }

  /** @param {number} point */
  #remove(point) {
    const remove = () => {
      this.points.delete(point);
      this.draw();
    };
    return el("button", { type: "button", class: "quiet small", "aria-label": `Remove point ${point}`, on: { click: remove } }, "Remove");
  }

  /** @param {number} point @param {HTMLButtonElement} button */
  async #run(point, button) {
    button.disabled = true;
    try {
      this.points.set(point, await api.post(`/sweeps/${this.sweep}/points/${point}/run`, { by: person() }));
      this.draw();
    } catch (error) {
      button.disabled = false;
      byId("chosen-refusal").textContent = `Not queued: ${explain(error)}`;
    }
  }
}
