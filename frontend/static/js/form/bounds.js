// @ts-check
import { ApiError } from "../api.js";

/** @typedef {Record<string, any>} Node */

/** Without the noise of a conversion: 0.3 * 0.001 is 0.0003. @param {number} value */
const clean = (value, digits = 15) => Number(value.toPrecision(digits));

/** An SI value as text in the unit shown. @param {any} si @param {Node} node */
export function shown(si, node) {
  if (si == null) return "";
  return typeof si === "number" ? String(clean(si / (node.factor ?? 1), 12)) : String(si);
}

/** Text in the unit shown as an SI value; text that is no number is left for the service, which reads `12 kip` too. @param {string} text @param {Node} node */
export function toSi(text, node) {
  const trimmed = text.trim().replaceAll("−", "-");
  if (!trimmed) return null;
  const value = Number(trimmed);
  return Number.isFinite(value) ? clean(value * (node.factor ?? 1)) : trimmed;
}

/** What is wrong with a number, its bound in the unit shown, or null. @param {any} si @param {Node} node @returns {string | null} */
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

/** The problems of a refused plan with paths into the plan, however the request wrapped it. @param {unknown} error */
export function planProblems(error) {
  if (!(error instanceof ApiError)) throw error;
  if (!error.errors.length) return [{ where: "", problem: error.message }];
  return error.errors.map((problem) => ({ ...problem, where: problem.where.replace(/^(body\.)?(plans?\.(\d+\.)?)?/, "") }));
}
