// @ts-check
import { el } from "../dom.js";
import { number } from "../format.js";

/**
 * @typedef {{name: string, unit: string, stated: string, samples: number, missing: number, smallest: number | null, largest: number | null, mean: number | null}} Column
 * @typedef {{roles: Record<string, {label: string, counts: string, dimensions: string[]}>, units: Record<string, string[]>}} Roles
 */

/** One column of the file with its role, station or floor, unit, gain, offset and sign, the reason for the proposal and the problems. */
export class ColumnRow {
  /** @param {Column} column @param {Roles} roles @param {string} id @param {(role: string) => number} free returns the next free number of a role */
  constructor(column, roles, id, free) {
    this.column = column;
    this.roles = roles;
    this.kept = {};
    const named = (/** @type {string} */ what) => ({ "aria-label": `${what} of ${column.name}`, "aria-describedby": id });
    const choices = Object.entries(roles.roles).map(([name, { label }]) => el("option", { value: name }, label));
    this.role = el("select", named("Role"), el("option", { value: "" }, "not used"), ...choices);
    this.number = el("input", { ...named("Station or floor"), type: "number", min: 1, max: 999 });
    this.unit = el("select", named("Unit"));
    this.gain = el("input", { ...named("Gain"), type: "text", autocomplete: "off", placeholder: "1" });
    this.offset = el("input", { ...named("Offset"), type: "text", inputmode: "decimal", autocomplete: "off", placeholder: "0" });
    this.reverse = el("input", { ...named("Reversed sign"), type: "checkbox" });
    this.why = el("p", { class: "muted" });
    this.wrong = el("ul", { class: "wrong" });
    this.role.addEventListener("change", () => this.#chosen(free));
    const cell = (/** @type {string} */ label, /** @type {any} */ control) => el("td", { "data-label": label }, control);
    this.element = el(
      "tr",
      {},
      el("th", { scope: "row" }, el("span", {}, column.name), el("small", { class: "muted" }, extent(column))),
      cell("Role", this.role),
      cell("Station or floor", this.number),
      cell("Unit", this.unit),
      cell("Gain", this.gain),
      cell("Offset", this.offset),
      cell("Reversed", this.reverse),
      el("td", { id, class: "notes" }, this.why, this.wrong),
    );
  }

  /** @param {any} channel of a mapping, or undefined if the column is not used @param {string} why */
  fill(channel, why) {
    const { column: _, role = "", number: at, unit, gain, offset, reverse, ...kept } = channel ?? {};
    this.kept = kept;
    this.role.value = role;
    this.number.value = at ?? "";
    this.#offerUnits(unit ?? "");
    this.gain.value = gain ?? "";
    this.offset.value = offset ? String(offset) : "";
    this.reverse.checked = Boolean(reverse);
    this.why.textContent = why;
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
    };
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

  #show() {
    const role = this.role.value;
    for (const control of [this.unit, this.gain, this.offset, this.reverse]) control.disabled = !role || (role === "t" && control !== this.unit);
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

/** The mean as text; 0 if the mean is negligible beside the values. @param {{smallest: number | null, largest: number | null, mean: number | null}} of */
export function meanOf({ smallest, largest, mean }) {
  const size = Math.max(Math.abs(smallest ?? 0), Math.abs(largest ?? 0));
  return Math.abs(mean ?? 0) < 1e-9 * size ? "0" : number(mean);
}

/** @param {Column} column */
function extent({ unit, samples, missing, smallest, largest, mean }) {
  const range = smallest == null ? "no values" : `${number(smallest)} to ${number(largest)}${unit && ` ${unit}`}, mean ${meanOf({ smallest, largest, mean })}`;
  return [`${samples} samples`, range, missing && `${missing} missing`].filter(Boolean).join("; ");
}
