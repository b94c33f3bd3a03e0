// @ts-check
import { el } from "../dom.js";
import { outOfBounds, shown, toSi } from "./bounds.js";
import { hintOf } from "./schema.js";

/**
 * Part of the form: `read` gives its value in SI, `problems` gives the errors that the form finds without the service,
 * and `refresh` updates the part after a change of the kind of test.
 * @typedef {{element: HTMLElement, read: () => any, problems: () => {where: string, problem: string}[], refresh?: () => void}} Part
 * @typedef {Record<string, any>} Node
 */

/** A control with its label, its hint and an element for its error. @param {string} path @param {string} label @param {any} control @param {string} hint */
export function labelled(path, label, control, hint = "", unit = "", wide = false) {
  control.id = `f-${path}`;
  control.dataset.path = path;
  control.setAttribute("aria-describedby", hint ? `h-${path} e-${path}` : `e-${path}`);
  return el(
    "div",
    { class: wide ? "field wide" : "field" },
    el("label", { for: control.id }, label, unit && el("span", { class: "unit" }, `, ${unit}`)),
    control,
    hint && el("small", { id: `h-${path}`, class: "hint" }, hint),
    el("small", { id: `e-${path}`, class: "error" }),
  );
}

/** A field for a number or a text. @param {Node} node @param {string} path @param {any} value @returns {Part} */
export function scalarField(node, path, value) {
  const numeric = node.type === "number" || node.type === "integer";
  const text = numeric ? shown(value, node) : (value ?? "");
  const control = node.maxLength > 1000 ? el("textarea", { rows: 2 }) : el("input", { type: "text", autocomplete: "off" });
  if (numeric) control.inputMode = "decimal";
  control.value = text;
  const read = () => {
    if (control.value === text) return value;
    if (numeric) return toSi(control.value, node);
    return control.value === "" && node.nullable ? null : control.value;
  };
  const problems = () => {
    const problem = numeric ? outOfBounds(read(), node) : null;
    return problem ? [{ where: path, problem }] : [];
  };
  return { element: labelled(path, node.title, control, hintOf(node), node.shown_label, node.maxLength > 100), read, problems };
}

/** A switch: yes or no. @param {Node} node @param {string} path @param {any} value @returns {Part} */
export function switchField(node, path, value) {
  const control = el("input", { type: "checkbox", role: "switch", checked: Boolean(value) });
  return { element: labelled(path, node.title, control, hintOf(node)), read: () => control.checked, problems: () => [] };
}

/** A field that selects one of several choices. @param {string} path @param {string} label @param {Map<string, string>} choices @param {string} value */
export function choiceField(path, label, choices, value, hint = "", wide = false) {
  const options = [...choices].map(([key, text]) => el("option", { value: key, selected: key === value }, text));
  const control = el("select", {}, ...options);
  return { element: labelled(path, label, control, hint, "", wide), control, read: () => control.value, problems: () => [] };
}

const MANY = 2000; // more numbers than this are not written into their field

/** A field for several numbers. A very long list is kept unchanged until other numbers are pasted over it. @param {Node} node @param {string} path @param {number[] | undefined} values @returns {Part} */
export function numbersField(node, path, values = []) {
  const many = node.maxItems > MANY;
  const text = values.length > MANY ? "" : values.map((value) => shown(value, node)).join(many ? " " : ", ");
  const control = many ? el("textarea", { rows: 3, spellcheck: "false" }, text) : el("input", { type: "text", autocomplete: "off", value: text });
  const read = () => (control.value === text ? values : control.value.split(/[,;\s]+/).filter(Boolean).map((/** @type {string} */ one) => toSi(one, node)));
  const problems = () => {
    const found = read();
    const bounds = { ...node.items, factor: node.factor, shown_label: node.shown_label };
    if (found.length < (node.minItems ?? 0)) return [{ where: path, problem: `needs at least ${node.minItems} ${node.minItems === 1 ? "number" : "numbers"}` }];
    const wrong = found.findIndex((/** @type {unknown} */ one) => typeof one !== "number" || outOfBounds(one, bounds));
    if (wrong < 0) return [];
    const problem = typeof found[wrong] === "number" ? outOfBounds(found[wrong], bounds) : `is not a valid number: ${found[wrong]}`;
    return [{ where: path, problem: `number ${wrong + 1} ${problem}` }];
  };
  const how = values.length > MANY ? `${values.length} numbers, kept unchanged; paste numbers to replace them` : "numbers separated by spaces or commas";
  const hint = [hintOf(node), how].filter(Boolean).join("; ");
  return { element: labelled(path, node.title, control, hint, node.shown_label, many), read, problems };
}

/** A value that the form keeps unchanged. @param {Node} node @param {any} value @returns {Part} */
export function keptField(node, value) {
  const what = Array.isArray(value) ? `${value.length} values` : String(value);
  return { element: el("p", { class: "muted" }, `${node.title}: ${what}, kept unchanged`), read: () => value, problems: () => [] };
}
