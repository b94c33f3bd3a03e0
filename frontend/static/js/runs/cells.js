// @ts-check
import { el } from "../dom.js";

/** @typedef {{key: string, label: string, group: string, kind: string, unit: string, heading: string, help: string, choices: {value: string, label: string}[]}} Column */
/** @typedef {{id: string, number: number, name: string, state: string, cells: any[]}} Row */

const WHOLE = ["number", "attempt", "seed", "template"];

/** A number with three significant digits, without exponent where it reads well. @param {number} value */
export function three(value) {
  const size = Math.abs(value);
  if (Number.isInteger(value) && size < 1e6) return String(value);
  if (size >= 1e6 || size < 1e-4) return value.toExponential(2).replace("e+", "e");
  return size >= 1000 ? String(Math.round(value)) : value.toPrecision(3);
}

/** Date and time of the browser, to the minute. @param {string} iso */
export function minute(iso) {
  const date = new Date(iso);
  const two = (/** @type {number} */ value) => String(value).padStart(2, "0");
  return `${date.getFullYear()}-${two(date.getMonth() + 1)}-${two(date.getDate())} ${two(date.getHours())}:${two(date.getMinutes())}`;
}

/** The text of a cell; a dash where the run has no value. @param {Column} column @param {any} value @returns {string} */
export function text(column, value) {
  if (value == null || value === "" || (Array.isArray(value) && !value.length)) return "–";
  if (column.kind === "time") return minute(value);
  if (column.kind === "flag") return value ? "yes" : "no";
  if (column.kind === "tags") return value.join(", ");
  if (column.kind === "number") return WHOLE.includes(column.key) || column.key.endsWith(".seed") ? String(value) : three(value);
  if (column.key === "digest") return value.slice(0, 12);
  return column.choices.find((one) => one.value === value)?.label ?? String(value);
}

/** What a cell shows. @param {Column} column @param {Row} row @param {any} value @returns {Node | string} */
export function shown(column, row, value) {
  const address = `/runs/${row.id}`;
  if (column.key === "number") return el("a", { href: address, class: "run-number" }, `#${row.number}`);
  if (column.key === "name") return el("a", { href: address, title: row.name }, row.name);
  if (column.key === "state") return el("span", { class: `badge ${row.state}` }, row.state);
  if (column.kind === "tags" && value?.length) return tagList(value);
  return text(column, value);
}

/** @param {string[]} tags */
export const tagList = (tags) => el("span", { class: "tags" }, ...tags.map((tag) => el("span", { class: "tag" }, tag)));
