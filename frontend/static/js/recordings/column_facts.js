// @ts-check
import { el } from "../dom.js";
import { number, significant } from "../format.js";

/**
 * A column of a file. `unit` is as the file writes it, `stated` the unit of the program that it names, `problem` why it names none.
 * @typedef {{name: string, quantity: string, unit: string, stated: string, problem: string, applied: string, samples: number, missing: number,
 *   dt_s: number | null, start_s: number, smallest: number | null, largest: number | null, mean: number | null}} Column
 */

/** What the file itself says about a column: its unit, its samples, its step, and the scale that was applied. @param {Column} column @returns {HTMLElement[]} */
export function factsOf(column) {
  const { samples, missing, smallest, largest, dt_s, start_s, applied, quantity } = column;
  const range = smallest == null ? "no values" : `${number(smallest)} to ${number(largest)}, mean ${meanOf(column)}`;
  const clock = dt_s && `${significant(1 / dt_s, 6)} Hz${start_s ? ` from ${number(start_s)} s` : ""}`;
  const lines = [
    [[`${samples} samples`, clock, missing && `${missing} missing`].filter(Boolean).join("; ")],
    [range],
    [unitOf(column), column.problem ? "unknown" : ""],
    quantity && [`quantity, as the file states it: ${quantity}`],
    applied && [`applied from the file: ${applied}`],
  ];
  return lines.filter(Boolean).map((/** @type {any} */ [text, kind = ""]) => el("small", { class: kind || "muted" }, text));
}

/** The mean as text; 0 if the mean is negligible beside the values. @param {{smallest: number | null, largest: number | null, mean: number | null}} of */
export function meanOf({ smallest, largest, mean }) {
  const size = Math.max(Math.abs(smallest ?? 0), Math.abs(largest ?? 0));
  return Math.abs(mean ?? 0) < 1e-9 * size ? "0" : number(mean);
}

/** @param {Column} column */
function unitOf({ unit, stated, problem }) {
  if (problem) return problem;
  if (!stated) return "no unit in the file";
  return unit && unit !== stated ? `unit in the file: ${unit} (${stated})` : `unit in the file: ${stated}`;
}
