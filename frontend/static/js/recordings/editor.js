// @ts-check
import { ApiError, api, explain } from "../api.js";
import { el } from "../dom.js";
import { contentsOf } from "../files/contents.js";
import { labelled } from "../form/field.js";
import { size } from "../format.js";
import { account, person, remember } from "../person.js";
import { ColumnRow, wrongItem } from "./column_row.js";
import { lagsOf } from "./lags.js";
import { factsLine, plotsOf } from "./plots.js";
import { savingOf } from "./saving.js";
import { MappingSettings } from "./settings.js";
import { chooser, fitting, startsOf } from "./starts.js";

/** @typedef {import("./column_row.js").Roles} Roles */

const QUIET_MS = 400;
const MANY = 12; // columns from which their table scrolls by itself, so that the rest of the page stays near
const HEADS = ["Column", "Role", "Station or floor", "Unit", "Gain", "Offset", "Reversed", "Lag, ms", "Reason and problems"];

/** The editor of a mapping: assigns roles to the columns of an uploaded file, previews the recording and imports it. */
export class Editor {
  /** @param {any} sent the service's description of the file @param {Roles} roles @param {(recording: any) => void} imported @param {() => void} saved */
  constructor(sent, roles, imported, saved) {
    this.sent = sent;
    this.imported = imported;
    this.saved = saved;
    this.asking = new AbortController();
    this.timer = 0;
    this.starts = startsOf(sent);
    const free = (/** @type {string} */ role) => this.#free(role);
    /** @type {ColumnRow[]} */
    this.rows = sent.columns.map((/** @type {any} */ column, /** @type {number} */ i) => new ColumnRow(column, roles, `column-${i}`, free));
    this.settings = new MappingSettings();
    this.general = el("ul", { class: "wrong" });
    this.verdict = el("p", { class: "facts-line", role: "status", tabindex: "-1" });
    this.lags = el("div", {});
    this.plots = el("div", {});
    this.who = el("input", { type: "text", autocomplete: "name", maxlength: 80 });
    this.who.value = person();
    this.element = this.#build();
    for (const event of ["input", "change"]) {
      for (const part of [this.table, this.settings.element]) part.addEventListener(event, () => this.#soon());
    }
    this.#fill(/** @type {import("./starts.js").Start} */ ([...this.starts.values()].flat()[0]));
  }

  #build() {
    const { sent } = this;
    this.table = el(
      "table",
      { class: "columns" },
      el("thead", {}, el("tr", {}, ...HEADS.map((text) => el("th", { scope: "col" }, text)))),
      el("tbody", {}, ...this.rows.map((row) => row.element)),
    );
    const from = chooser(this.starts, (start) => this.#fill(start));
    const text = el("input", { type: "file", accept: ".yaml,.yml" });
    text.addEventListener("change", () => this.#load(text));
    const notes = sent.notes.map((/** @type {string} */ note) => el("li", {}, note));
    return el(
      "form",
      { class: "editor", novalidate: true, "aria-label": `Mapping of ${sent.filename}`, on: { submit: (/** @type {Event} */ event) => this.#import(event) } },
      el("h3", {}, sent.filename),
      el("p", { class: "muted" }, `${sent.format}, ${size(sent.size)}, SHA-256 ${sent.sha256.slice(0, 12)}…`),
      contentsOf(sent, sent.columns.map((/** @type {any} */ column) => column.name)),
      el("h4", {}, "Columns and their roles"),
      notes.length > 0 && el("ul", { class: "warnings" }, ...notes),
      el("div", { class: "starters" }, labelled("mapping.from", "Mapping", from, fitting(sent)), labelled("mapping.text", "Load a mapping from YAML", text)),
      el("div", { class: this.rows.length > MANY ? "scroll long" : "scroll", tabindex: "0", role: "region", "aria-label": "Columns of the file" }, this.table),
      this.settings.element,
      this.general,
      this.verdict,
      this.lags,
      el("div", { class: "starters sending" }, account() === null && labelled("mapping.who", "Your name", this.who), el("button", { type: "submit" }, "Import the recording")),
      savingOf(sent.sha256, () => this.#mapping(), () => this.who.value.trim(), () => this.saved()),
      el("h4", {}, "Signals"),
      el("p", { class: "muted hint" }, "The cursor stands on samples of the file. Drag over a plot to zoom, and double-click to reset. The slider below a plot takes the arrow keys, + and −."),
      this.plots,
    );
  }

  /** @param {import("./starts.js").Start} start */
  #fill({ mapping, why, doubtful }) {
    const names = this.rows.map((row) => row.column.name);
    const named = (/** @type {any} */ one) => (typeof one.column === "number" ? { ...one, column: names[one.column - 1] } : one);
    const channels = new Map(mapping.channels.map(named).map((/** @type {any} */ one) => [one.column, one]));
    for (const row of this.rows) {
      const channel = channels.get(row.column.name);
      row.fill(channel, why(row.column.name), Boolean(channel) && doubtful(row.column.name));
    }
    this.settings.fill(mapping, this.sent.filename.replace(/\.[^.]*$/, ""));
    this.#ask();
  }

  /** @param {any} input */
  async #load(input) {
    try {
      const { mapping } = await api.post("/recordings/preview", { file: this.sent.sha256, mapping: await input.files[0].text() });
      this.#fill({ label: "", mapping, why: () => `from ${input.files[0].name}`, doubtful: () => false });
    } catch (error) {
      this.#refused(error);
    }
  }

  /** The used channels with their rows, in the order of the request. @returns {{row: ColumnRow, channel: any}[]} */
  #used() {
    return this.rows.map((row) => ({ row, channel: row.read() })).filter(({ channel }) => channel);
  }

  #mapping() {
    return { ...this.settings.read(), channels: this.#used().map(({ channel }) => channel) };
  }

  /** @param {string} role */
  #free(role) {
    const taken = new Set(this.rows.filter((row) => row.role.value === role && row.number.value).map((row) => Number(row.number.value)));
    let at = 1;
    while (taken.has(at)) at++;
    return at;
  }

  #soon() {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.#ask(), QUIET_MS);
  }

  async #ask() {
    this.asking.abort();
    const mine = (this.asking = new AbortController());
    this.#askRate();
    if (!this.#used().length) {
      this.#clear();
      return this.#say("Not ready to import. Assign a role to at least one column.");
    }
    try {
      const found = await api.post("/recordings/preview", { file: this.sent.sha256, mapping: this.#mapping() }, mine.signal);
      this.#show(found);
    } catch (error) {
      if (!mine.signal.aborted) this.#refused(error);
    }
  }

  /** Ask for the rate where no column is time and a used column has no step. */
  #askRate() {
    const used = this.#used();
    const timed = used.some(({ channel }) => channel.role === "t");
    const without = used.filter(({ row, channel }) => row.column.dt_s == null && !channel.rate && !channel.time);
    this.settings.ask(!timed && without.length > 0, Math.max(0, ...without.map(({ row }) => row.column.samples)));
  }

  /** Set the lag of a channel, which the person has asked for. @param {import("./lags.js").Lag} lag @param {any} found */
  #applyLag({ behind, lag_s }, found) {
    const { column } = found.channels.find((/** @type {any} */ one) => one.key === behind);
    const row = /** @type {ColumnRow} */ (this.rows.find((one) => one.column.name === column));
    row.shift(row.seconds + lag_s);
    row.lag.focus();
    this.#ask();
  }

  /** @param {any} found */
  #show(found) {
    this.#clear();
    for (const { column, moved } of found.channels) this.rows.find((row) => row.column.name === column)?.tellClock(moved);
    this.lags.replaceChildren(lagsOf(found.lags, (lag) => this.#applyLag(lag, found)));
    this.#place(found.findings.map((/** @type {any} */ one) => ({ ...one, row: this.rows.find((row) => row.column.name === one.column) })));
    const errors = found.findings.filter((/** @type {any} */ one) => one.severity === "error").length;
    const warnings = found.findings.length - errors;
    const counted = [errors && `${errors} ${errors === 1 ? "error" : "errors"}`, warnings && `${warnings} ${warnings === 1 ? "warning" : "warnings"}`];
    const judged = counted.filter(Boolean).join(" and ") || "no errors or warnings";
    this.#say(found.samples ? `${factsLine(found)}: ${judged}` : `Not ready to import: ${judged}`);
    const { mapping } = found;
    const part = (/** @type {number} */ from_s, /** @type {number} */ to_s) => api.post("/recordings/preview", { file: this.sent.sha256, mapping, from_s, to_s });
    this.plots.replaceChildren(plotsOf(found, part));
  }

  /** @param {unknown} error */
  #refused(error) {
    this.#clear();
    if (!(error instanceof ApiError) || error.status !== 422 || !error.errors.length) return this.#say(explain(error));
    const used = this.#used();
    const problems = error.errors.map((one) => {
      const channel = one.where.match(/^mapping\.channels\.(\d+)/);
      const row = channel ? used[Number(channel[1])]?.row : used.find(({ channel: sent }) => one.where.startsWith(keyOf(sent)))?.row;
      return { ...one, row, severity: "error" };
    });
    this.#place(problems);
    this.#say("Not ready to import. The errors are beside the columns and fields.");
  }

  /** Show each problem beside its column or its field, and the other problems below the table. @param {any[]} problems */
  #place(problems) {
    /** @type {Map<ColumnRow, any[]>} */
    const beside = new Map();
    for (const one of problems) {
      const text = [one.time_s == null ? "" : `at ${one.time_s} s: `, one.problem, one.value && `, ${one.value}`, one.fix && ` (${one.fix})`].filter(Boolean).join("");
      if (one.row) beside.set(one.row, [...(beside.get(one.row) ?? []), { severity: one.severity, text }]);
      else if (!this.settings.tell(one.where, text)) this.general.append(wrongItem({ severity: one.severity, text: one.where ? `${one.where}: ${text}` : text }));
    }
    for (const [row, found] of beside) row.tell(found);
  }

  #clear() {
    for (const row of this.rows) {
      row.tell([]);
      row.tellClock("");
    }
    this.settings.clear();
    this.general.replaceChildren();
    this.lags.replaceChildren();
    this.plots.replaceChildren(el("p", { class: "empty" }, "The plots appear here when the mapping can be used."));
  }

  /** @param {string} text */
  #say(text) {
    this.verdict.textContent = text;
  }

  /** @param {Event} event */
  async #import(event) {
    event.preventDefault();
    clearTimeout(this.timer);
    this.asking.abort();
    remember(this.who.value.trim());
    const mapping = this.#mapping();
    try {
      this.imported(await api.post("/recordings", { file: this.sent.sha256, mapping, name: mapping.title, imported_by: this.who.value.trim() }));
    } catch (error) {
      this.#refused(error);
      (this.element.querySelector("tr.refused select") ?? this.verdict).focus();
    }
  }
}

/** The key of a channel in the recording. @param {any} channel */
const keyOf = ({ role, number }) => (number ? `${role}.${number}` : role);
