// @ts-check
import { ApiError, api, explain } from "../api.js";
import { el } from "../dom.js";
import { labelled } from "../form/field.js";
import { size } from "../format.js";
import { person, remember } from "../person.js";
import { ColumnRow, wrongItem } from "./column_row.js";
import { factsLine, plotsOf } from "./plots.js";
import { MappingSettings } from "./settings.js";

/** @typedef {import("./column_row.js").Roles} Roles */

const QUIET_MS = 400;
const HEADS = ["Column", "Role", "Station or floor", "Unit", "Gain", "Offset", "Reversed", "Reason and problems"];

/** The editor of a mapping: assigns roles to the columns of an uploaded file, previews the recording and imports it. */
export class Editor {
  /** @param {any} sent the service's description of the file @param {Roles} roles @param {(recording: any) => void} imported */
  constructor(sent, roles, imported) {
    this.sent = sent;
    this.imported = imported;
    this.asking = new AbortController();
    this.timer = 0;
    const free = (/** @type {string} */ role) => this.#free(role);
    /** @type {ColumnRow[]} */
    this.rows = sent.columns.map((/** @type {any} */ column, /** @type {number} */ i) => new ColumnRow(column, roles, `column-${i}`, free));
    this.settings = new MappingSettings();
    this.general = el("ul", { class: "wrong" });
    this.verdict = el("p", { class: "facts-line", role: "status", tabindex: "-1" });
    this.plots = el("div", {});
    this.who = el("input", { type: "text", autocomplete: "name", maxlength: 80 });
    this.who.value = person();
    this.element = this.#build();
    for (const event of ["input", "change"]) {
      for (const part of [this.table, this.settings.element]) part.addEventListener(event, () => this.#soon());
    }
    this.#fill(sent.guess ?? { channels: [] }, (name) => sent.reasons[name] ?? sent.left_out[name] ?? "");
  }

  #build() {
    const { sent } = this;
    this.table = el(
      "table",
      { class: "columns" },
      el("thead", {}, el("tr", {}, ...HEADS.map((text) => el("th", { scope: "col" }, text)))),
      el("tbody", {}, ...this.rows.map((row) => row.element)),
    );
    const offered = sent.mappings.map((/** @type {any} */ one, /** @type {number} */ i) => el("option", { value: i }, `mapping of ${one.name}, imported ${one.imported_at.slice(0, 10)}`));
    const from = el("select", {}, el("option", { value: "" }, "proposed from names and signals"), ...offered);
    from.addEventListener("change", () => this.#apply(from.value));
    const fits = offered.length ? `${offered.length} earlier ${offered.length === 1 ? "mapping fits" : "mappings fit"} this file` : "no earlier mapping fits this file";
    const text = el("input", { type: "file", accept: ".yaml,.yml" });
    text.addEventListener("change", () => this.#load(text));
    const notes = sent.notes.map((/** @type {string} */ note) => el("li", {}, note));
    return el(
      "form",
      { class: "editor", novalidate: true, "aria-label": `Mapping of ${sent.filename}`, on: { submit: (/** @type {Event} */ event) => this.#import(event) } },
      el("h3", {}, sent.filename),
      el("p", { class: "muted" }, `${sent.format}, ${size(sent.size)}, SHA-256 ${sent.sha256.slice(0, 12)}…`),
      notes.length > 0 && el("ul", { class: "warnings" }, ...notes),
      el("div", { class: "starters" }, labelled("mapping.from", "Mapping", from, fits), labelled("mapping.text", "Load a mapping from YAML", text)),
      el("div", { class: "scroll", tabindex: "0", role: "region", "aria-label": "Columns of the file" }, this.table),
      this.settings.element,
      this.general,
      this.verdict,
      el("div", { class: "starters sending" }, labelled("mapping.who", "Your name", this.who), el("button", { type: "submit" }, "Import the recording")),
      this.plots,
    );
  }

  /** @param {any} mapping @param {(column: string) => string} why */
  #fill(mapping, why) {
    const names = this.rows.map((row) => row.column.name);
    const named = (/** @type {any} */ one) => (typeof one.column === "number" ? { ...one, column: names[one.column - 1] } : one);
    const channels = new Map(mapping.channels.map(named).map((/** @type {any} */ one) => [one.column, one]));
    for (const row of this.rows) row.fill(channels.get(row.column.name), why(row.column.name));
    this.settings.fill(mapping, this.sent.filename.replace(/\.[^.]*$/, ""));
    this.#ask();
  }

  /** @param {string} chosen */
  #apply(chosen) {
    const { guess, mappings, reasons, left_out } = this.sent;
    if (!chosen) return this.#fill(guess ?? { channels: [] }, (name) => reasons[name] ?? left_out[name] ?? "");
    const { mapping, name } = mappings[Number(chosen)];
    this.#fill({ ...mapping, title: "" }, () => `from the mapping of ${name}`);
  }

  /** @param {any} input */
  async #load(input) {
    try {
      const { mapping } = await api.post("/recordings/preview", { file: this.sent.sha256, mapping: await input.files[0].text() });
      this.#fill(mapping, () => `from ${input.files[0].name}`);
    } catch (error) {
      this.#refused(error);
    }
  }

  /** The used channels with their rows, in the order of the request. */
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

  /** @param {any} found */
  #show(found) {
    this.#clear();
    this.#place(found.findings.map((/** @type {any} */ one) => ({ ...one, row: this.rows.find((row) => row.column.name === one.column) })));
    const errors = found.findings.filter((/** @type {any} */ one) => one.severity === "error").length;
    const warnings = found.findings.length - errors;
    const counted = [errors && `${errors} ${errors === 1 ? "error" : "errors"}`, warnings && `${warnings} ${warnings === 1 ? "warning" : "warnings"}`];
    const judged = counted.filter(Boolean).join(" and ") || "no errors or warnings";
    this.#say(found.samples ? `${factsLine(found)}: ${judged}` : `Not ready to import: ${judged}`);
    this.plots.replaceChildren(plotsOf(found));
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
    for (const row of this.rows) row.tell([]);
    this.settings.clear();
    this.general.replaceChildren();
    this.plots.replaceChildren();
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
