// @ts-check
import { el } from "../dom.js";
import { outOfBounds, shown, toSi } from "./bounds.js";
import { labelled } from "./field.js";
import { hintOf } from "./schema.js";

/** @typedef {import("./field.js").Part} Part @typedef {import("./field.js").Node} Node */

/** A matrix as text, one row per line. Cells of a spreadsheet can be pasted. @param {Node} node @param {string} path @param {number[][] | undefined} rows @returns {Part} */
export function matrixField(node, path, rows = []) {
  const text = rows.map((row) => row.map((value) => shown(value, node)).join("  ")).join("\n");
  const lines = Math.min(10, Math.max(3, rows.length));
  const control = el("textarea", { rows: lines, spellcheck: "false", autocomplete: "off", wrap: "off", class: "matrix" }, text);
  const read = () => (control.value === text ? rows : parsed(control.value, node));
  const problems = () => {
    const problem = wrong(read(), node);
    return problem ? [{ where: path, problem }] : [];
  };
  const hint = [hintOf(node), "one row per line; separate numbers with spaces, commas or tabs"].filter(Boolean).join("; ");
  return { element: labelled(path, node.title, control, hint, node.shown_label, true), read, problems };
}

/** @param {string} text @param {Node} node @returns {any[][]} */
function parsed(text, node) {
  const lines = text.split(/\r?\n/).filter((line) => line.trim());
  return lines.map((line) => line.trim().split(/[\s,;]+/).filter(Boolean).map((cell) => toSi(cell, node)));
}

/** The first problem of the numbers in the rows, or null. The service checks the matrix as a whole. @param {any[][]} rows @param {Node} node */
function wrong(rows, node) {
  if (!rows.length) return node.minItems ? "is required" : null;
  const bounds = { ...node.items.items, factor: node.factor, shown_label: node.shown_label };
  for (const [i, row] of rows.entries()) {
    if (row.length !== rows[0].length) return `row ${i + 1} has ${row.length} numbers, row 1 has ${rows[0].length}`;
    for (const [j, cell] of row.entries()) {
      const problem = typeof cell === "number" ? outOfBounds(cell, bounds) : `is not a valid number: ${cell}`;
      if (problem) return `row ${i + 1}, column ${j + 1} ${problem}`;
    }
  }
  return null;
}
