// @ts-check
import { byId, el } from "../dom.js";
import { parts, quoted } from "./view.js";

/** @typedef {import("./cells.js").Column} Column */

/** @type {Record<string, [string, string][]>} */
const OPERATORS = {
  number: [["<", "is below"], ["<=", "is at most"], [">=", "is at least"], [">", "is above"], ["=", "equals"], ["!=", "differs from"]],
  time: [[">=", "is from"], ["<=", "is until"], ["=", "is on"]],
  text: [["~", "contains"], ["!~", "does not contain"], ["=", "equals"], ["!=", "differs from"]],
  choice: [["=", "is"], ["!=", "is not"]],
  tags: [["=", "has the tag"], ["!=", "does not have the tag"], ["~", "contains"]],
  flag: [["=", "is"]],
};
const EMPTY = /** @type {[string, string][]} */ ([["none", "has no value"], ["any", "has a value"]]);

/** The condition in words: `MTE, station 1 < 0.5 mm`. @param {string} condition @param {Map<string, Column>} known */
export function inWords(condition, known) {
  const { key, operator, value } = parts(condition);
  const column = known.get(key === "tag" ? "tags" : key);
  if (!column) return condition;
  if (!value) return `${column.label}: ${operator === "=" ? "no value" : "any value"}`;
  const sign = { "~": "contains", "!~": "without", ">=": "≥", "<=": "≤", "!=": "≠" }[operator] ?? operator;
  const said = value.split("|").map((/** @type {string} */ one) => column.choices.find((choice) => choice.value === one)?.label ?? one).join(" or ");
  return `${column.label} ${sign} ${said}${column.unit && /^[-+.\de]+$/.test(value) ? ` ${column.unit}` : ""}`;
}

/** Edit a condition of a column. @param {Column} column @param {string} condition @param {string[]} tags @param {(condition: string) => void} done */
export function editFilter(column, condition, tags, done) {
  const dialog = byId("filter-dialog");
  const kind = column.kind === "text" && column.choices.length ? "choice" : column.kind;
  const given = condition ? parts(condition) : { operator: OPERATORS[kind][0][0], value: "" };
  const start = condition && !given.value ? (given.operator === "=" ? "none" : "any") : given.operator;
  const operator = byId("filter-operator");
  operator.replaceChildren(...[...OPERATORS[kind], ...(kind === "flag" ? [] : EMPTY)].map(([value, label]) => el("option", { value, selected: value === start }, label)));
  const value = kind === "choice" || kind === "flag" ? choice(column, given.value) : field(column, given.value.replace(/^"(.*)"$/s, "$1").replaceAll('""', '"'), tags);
  byId("filter-title").textContent = `Filter: ${column.label}`;
  byId("filter-value").replaceChildren(el("label", { for: "filter-input" }, column.unit ? `Value, ${column.unit}` : "Value"), value);
  byId("filter-hint").textContent = hint(column, kind);
  const showValue = () => (byId("filter-value").hidden = operator.value === "none" || operator.value === "any");
  operator.onchange = showValue;
  showValue();
  byId("filter-form").onsubmit = () => {
    const chosen = value.tagName === "SELECT" ? [...value.selectedOptions].map((one) => one.value).join("|") : quoted(value.value.trim());
    const empty = { none: `${column.key}=`, any: `${column.key}!=` }[/** @type {string} */ (operator.value)];
    if (empty ?? chosen) done(empty ?? `${column.key}${operator.value}${chosen}`);
  };
  dialog.showModal();
  (value.offsetParent ? value : operator).focus();
}

/** @param {Column} column @param {string} value */
function choice(column, value) {
  const chosen = value.split("|");
  return el("select", { id: "filter-input", multiple: column.kind !== "flag", size: Math.min(8, column.choices.length) },
    ...column.choices.map((one) => el("option", { value: one.value, selected: chosen.includes(one.value) }, one.label)));
}

/** @param {Column} column @param {string} value @param {string[]} tags */
function field(column, value, tags) {
  byId("known-tags").replaceChildren(...tags.map((tag) => el("option", { value: tag })));
  return el("input", { id: "filter-input", value, autocomplete: "off", list: column.kind === "tags" && "known-tags", inputmode: column.kind === "number" && "decimal" });
}

/** @param {Column} column @param {string} kind */
function hint(column, kind) {
  if (kind === "time") return "A date such as 2026-11-23, a time such as 2026-11-23T14:00, or an age: -12h, -7d. UTC.";
  if (kind === "number") return column.unit ? `A number in ${column.unit}, or a number with its unit.` : "A number.";
  if (kind === "choice") return "Hold Ctrl to choose several.";
  return column.help;
}
