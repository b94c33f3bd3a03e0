// @ts-check
import { el } from "../dom.js";
import { factsOf } from "./column_facts.js";

/** @typedef {import("./column_facts.js").Column} Column @typedef {{roles: Record<string, {label: string, counts: string, dimensions: string[]}>, units: Record<string, string[]>}} Roles */

const GUESS = "A guess"; // a reason in doubt begins so

/** One column of the file with its role, station or floor, unit, gain, offset, sign and lag, the reason for the proposal and its doubt, and the problems. */
export class ColumnRow {
  /** @param {Column} column @param {Roles} roles @param {string} id @param {(role: string) => number} free returns the next free number of a role */
  constructor(column, roles, id, free) {
    this.column = column;
    this.roles = roles;
    this.kept = {};
    this.seconds = 0;
    const named = (/** @type {string} */ what) => ({ "aria-label": `${what} of ${column.name}`, "aria-describedby": id });
    const choices = Object.entries(roles.roles).map(([name, { label }]) => el("option", { value: name }, label));
    this.role = el("select", named("Role"), el("option", { value: "" }, "not used"), ...choices);
    this.number = el("input", { ...named("Station or floor"), type: "number", min: 1, max: 999 });
    this.unit = el("select", named("Unit"));
    this.gain = el("input", { ...named("Gain"), type: "text", autocomplete: "off", placeholder: "1" });
    this.offset = el("input", { ...named("Offset"), type: "text", inputmode: "decimal", autocomplete: "off", placeholder: "0" });
    this.reverse = el("input", { ...named("Reversed sign"), type: "checkbox" });
    this.lag = el("input", { ...named("Lag, ms,"), type: "text", inputmode: "decimal", autocomplete: "off", placeholder: "0" });
    this.doubt = el("strong", { class: "doubt" }, GUESS);
    this.why = el("span", {});
    this.moved = el("p", { class: "muted" });
    this.wrong = el("ul", { class: "wrong" });
    this.role.addEventListener("change", () => this.#chosen(free));
    const cell = (/** @type {string} */ label, /** @type {any} */ control) => el("td", { "data-label": label }, control);
    this.element = el(
      "tr",
      {},
      el("th", { scope: "row" }, el("span", {}, column.name), ...factsOf(column)),
      cell("Role", this.role),
      cell("Station or floor", this.number),
      cell("Unit", this.unit),
      cell("Gain", this.gain),
      cell("Offset", this.offset),
      cell("Reversed", this.reverse),
      cell("Lag, ms", this.lag),
      el("td", { id, class: "notes" }, el("p", { class: "muted" }, this.doubt, this.why), this.wrong, this.moved),
    );
  }

  /** @param {any} channel of a mapping, or undefined if the column is not used @param {string} why @param {boolean} doubtful */
  fill(channel, why, doubtful) {
    const { column: _, role = "", number: at, unit, gain, offset, reverse, lag, ...kept } = channel ?? {};
    this.kept = kept;
    this.shift(lag ?? 0);
    this.doubt.hidden = !doubtful;
    this.role.value = role;
    this.number.value = at ?? "";
    this.#offerUnits(unit ?? "");
    this.gain.value = gain ?? "";
    this.offset.value = offset ? String(offset) : "";
    this.reverse.checked = Boolean(reverse);
    this.why.textContent = doubtful ? why.replace(/^a guess/, "") : why;
    this.tell([]);
    this.#show();
  }

  /** The channel in the form of a mapping, or null if the column is not used. */
  read() {
    const role = this.role.value;
    if (!role) return null;
    const counted = this.roles.roles[role].counts && this.number.value;
    return {
      ...this.kept,
      column: this.column.name,
      role,
      number: counted ? Number(this.number.value) : null,
      unit: this.unit.value,
      gain: this.gain.value.trim() || null,
      offset: numeric(this.offset.value) ?? 0,
      reverse: this.reverse.checked,
      lag: this.#lagSeconds(),
    };
  }

  /** Set the lag of the clock. @param {number} seconds */
  shift(seconds) {
    this.seconds = seconds;
    this.lag.value = seconds ? milliseconds(seconds) : "";
  }

  /** Say how the samples came to the clock of the recording. @param {string} moved empty: they are the samples of the file */
  tellClock(moved) {
    this.moved.textContent = moved && `Clock of the recording: ${moved}.`;
  }

  /** Show the problems of this column. @param {{severity: string, text: string}[]} findings */
  tell(findings) {
    this.wrong.replaceChildren(...findings.map(wrongItem));
    this.element.classList.toggle("refused", findings.some(({ severity }) => severity === "error"));
  }

  /** @param {(role: string) => number} free */
  #chosen(free) {
    const role = this.role.value;
    this.number.value = "";
    if (role && this.roles.roles[role].counts) this.number.value = String(free(role));
    this.why.textContent = role ? "your choice" : "";
    this.doubt.hidden = true;
    this.kept = {};
    this.#offerUnits(this.unit.value || this.column.stated);
    this.#show();
  }

  /** Offer the units that match the role first, then the units that need a gain; no unit is chosen for the person. @param {string} wanted */
  #offerUnits(wanted) {
    if (!this.role.value) return this.unit.replaceChildren();
    const { dimensions } = this.roles.roles[this.role.value];
    const fitting = dimensions.flatMap((one) => this.roles.units[one]);
    const others = Object.values(this.roles.units).flat().filter((unit) => !fitting.includes(unit));
    const options = (/** @type {string[]} */ units) => units.map((unit) => el("option", { value: unit }, unit));
    this.unit.replaceChildren(
      el("option", { value: "" }, "choose the unit"),
      el("optgroup", { label: "units of this role" }, ...options(fitting)),
      el("optgroup", { label: "units that need a gain" }, ...options(others)),
    );
    this.unit.value = fitting.includes(wanted) || others.includes(wanted) ? wanted : "";
  }

  /** The lag in s: unchanged where its text is unchanged; other text is passed on, and the service refuses it. */
  #lagSeconds() {
    const text = this.lag.value.trim();
    if (text === (this.seconds ? milliseconds(this.seconds) : "")) return this.seconds;
    const value = numeric(text);
    return typeof value === "number" ? Number((value / 1e3).toPrecision(15)) : (value ?? 0);
  }

  #show() {
    const role = this.role.value;
    for (const control of [this.unit, this.gain, this.offset, this.reverse, this.lag]) control.disabled = !role || (role === "t" && control !== this.unit);
    this.number.disabled = !role || !this.roles.roles[role].counts;
    if (this.number.disabled) this.number.value = "";
    this.element.classList.toggle("unused", !role);
  }
}

/** @param {{severity: string, text: string}} finding */
export const wrongItem = ({ severity, text }) => el("li", { class: severity }, el("strong", {}, severity === "error" ? "Error: " : "Warning: "), text);

/** Convert text to a number. Other text is passed on: the service refuses it. @param {string} text */
export function numeric(text) {
  const trimmed = text.trim();
  if (!trimmed) return null;
  return Number.isFinite(Number(trimmed)) ? Number(trimmed) : trimmed;
}

/** @param {number} seconds */
const milliseconds = (seconds) => String(Number((seconds * 1e3).toPrecision(9)));
