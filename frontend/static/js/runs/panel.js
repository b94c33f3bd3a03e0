// @ts-check
import { api, explain } from "../api.js";
import { byId, el } from "../dom.js";
import { about } from "./about.js";
import { minute, three } from "./cells.js";

/** @typedef {import("./cells.js").Row} Row */
/** @typedef {{key: string, label: string, scope: string, shown_label: string, tests: string[], meaning: string, further: boolean}} Measure */

const WAIT_MS = 120; // rows passed by faster than this are not loaded
const ENDED = ["completed", "tripped", "cancelled", "failed"];

/** The side panel: the focused run with its measures, and what people say about it. */
export class Panel {
  /** @param {{tags: () => string[], changed: () => void, archive: (run: any) => void, remove: (run: any) => void}} listener */
  constructor(listener) {
    this.listener = listener;
    this.id = "";
    /** @type {Measure[] | null} */
    this.measures = null;
    /** @type {ReturnType<typeof setTimeout> | undefined} */
    this.timer = undefined;
    byId("panel-close").addEventListener("click", () => this.open(false));
  }

  /** @param {boolean} on */
  open(on) {
    byId("panel").classList.toggle("open", on);
  }

  /** @param {Row} row @param {boolean} asked by a click: opens the panel where it is not beside the table */
  show(row, asked) {
    if (asked) this.open(true);
    if (this.id === row.id) return;
    this.id = row.id;
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.load(row), asked ? 0 : WAIT_MS);
  }

  clear() {
    this.id = "";
    byId("panel-content").replaceChildren(el("p", { class: "muted" }, "The run that you focus appears here with its measures, tags and notes."));
  }

  /** @param {Row} row */
  async load(row) {
    try {
      this.measures ??= (await api.get("/schema")).measures;
      const run = await api.get(`/runs/${row.id}`);
      if (this.id === row.id) this.draw(run);
    } catch (error) {
      byId("panel-content").replaceChildren(el("p", { class: "note bad" }, explain(error)));
    }
  }

  /** @param {any} run */
  draw(run) {
    const ended = ENDED.includes(run.state);
    const button = (/** @type {string} */ label, /** @type {() => void} */ act) => el("button", { type: "button", class: "quiet small", "data-needs": "engineer", on: { click: act } }, label);
    byId("panel-content").replaceChildren(
      el("div", { class: "panel-head" }, el("a", { href: `/runs/${run.id}`, class: "run-number" }, `Run #${run.number}`), el("span", { class: `badge ${run.state}` }, run.state)),
      el("p", { class: "muted" }, `${run.submitted_by}, ${minute(run.submitted_at)}`),
      ...(run.reason && run.state !== "completed" ? [el("p", { class: "panel-reason" }, run.reason)] : []),
      ...this.tables(run),
      ...about(run, this.listener.tags(), () => this.listener.changed()),
      el("div", { class: "actions" },
        el("a", { href: `/runs/${run.id}`, class: "button small" }, "Open run"),
        el("a", { href: `/new?from=${run.id}`, class: "button quiet small", "data-needs": "engineer" }, "Edit and run again"),
        ended && !run.deleted_at && button(run.archived ? "Unarchive run" : "Archive run", () => this.listener.archive(run)),
        ended && !run.deleted_at && button("Delete run", () => this.listener.remove(run))),
    );
  }

  /** The main measures: a row for each, a column for each station. @param {any} run @returns {HTMLElement[]} */
  tables(run) {
    const used = (this.measures ?? []).filter((one) => one.tests.includes(run.test) && !one.further);
    const value = (/** @type {any} */ one) => (one == null ? "–" : three(one));
    const rows = used.filter((one) => one.scope === "station" && run.stations.length).map((one) =>
      el("tr", {}, el("th", { scope: "row", title: one.meaning }, heading(one)), ...run.stations.map((/** @type {any} */ station) => el("td", { class: "number" }, value(station[one.key])))));
    const head = el("tr", {}, el("td"), ...run.stations.map((/** @type {any} */ station) => el("th", { scope: "col", class: "number" }, station.name)));
    const whole = used.filter((one) => one.scope !== "station" && run[one.key] != null).map((one) =>
      el("div", {}, el("dt", {}, heading(one)), el("dd", {}, [run[one.key]].flat().map(value).join(" / "))));
    return [
      ...(rows.length ? [el("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": "Measures of the focused run" }, el("table", { class: "compact" }, el("thead", {}, head), el("tbody", {}, ...rows)))] : []),
      ...(whole.length ? [el("dl", { class: "whole" }, ...whole)] : []),
    ];
  }
}

/** @param {Measure} one */
const heading = (one) => (one.shown_label ? `${one.label}, ${one.shown_label}` : one.label);
