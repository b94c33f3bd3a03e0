// @ts-check
import { ApiError } from "../api.js";

/** @typedef {Record<string, any>} Node */

/** Round off the error of a unit conversion: 0.3 * 0.001 gives 0.0003. @param {number} value */
const clean = (value, digits = 15) => Number(value.toPrecision(digits));

/** An SI value as text in the unit shown. @param {any} si @param {Node} node */
export function shown(si, node) {
  if (si == null) return "";
  return typeof si === "number" ? String(clean(si / (node.factor ?? 1), 12)) : String(si);
}

/** Convert text in the shown unit to an SI value. Other text is passed on: the service also reads `12 kip`. @param {string} text @param {Node} node */
export function toSi(text, node) {
  const trimmed = text.trim().replaceAll("−", "-");
  if (!trimmed) return null;
  const value = Number(trimmed);
  return Number.isFinite(value) ? clean(value * (node.factor ?? 1)) : trimmed;
}

/** The problem of a number, with its bound in the shown unit, or null. @param {any} si @param {Node} node @returns {string | null} */
export function outOfBounds(si, node) {
  if (si === null) return node.nullable ? null : "is required";
  if (typeof si !== "number") return null;
  const bound = (/** @type {number} */ value) => [shown(value, node), node.shown_label].filter(Boolean).join(" ");
  if (node.type === "integer" && !Number.isInteger(si)) return "needs a whole number";
  if (node.minimum !== undefined && si < node.minimum) return `needs at least ${bound(node.minimum)}`;
  if (node.exclusiveMinimum !== undefined && si <= node.exclusiveMinimum) return `needs more than ${bound(node.exclusiveMinimum)}`;
  if (node.maximum !== undefined && si > node.maximum) return `needs at most ${bound(node.maximum)}`;
  if (node.exclusiveMaximum !== undefined && si >= node.exclusiveMaximum) return `needs less than ${bound(node.exclusiveMaximum)}`;
  return null;
}

/** The problems of a refused plan, with paths relative to the plan. @param {unknown} error */
export function planProblems(error) {
  if (!(error instanceof ApiError)) throw error;
  if (!error.errors.length) return [{ where: "", problem: error.message }];
  return error.errors.map((problem) => ({ ...problem, where: problem.where.replace(/^(body\.)?(plans?\.(\d+\.)?)?/, "") }));
}
