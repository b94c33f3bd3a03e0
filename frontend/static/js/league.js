// @ts-check
// Sorts the table of the league by the column whose heading is pressed; rows without a value stay last.
import { byId } from "./dom.js";

const table = /** @type {HTMLTableElement} */ (byId("league"));
const body = table.tBodies[0];

/** The value of a row in a column: a number, else text; null where there is none.
 * @param {HTMLTableRowElement} row
 * @param {number} column
 * @returns {number | string | null} */
function valueOf(row, column) {
  const text = row.cells[column].dataset.value ?? "";
  if (text === "") return null;
  return Number.isNaN(Number(text)) ? text : Number(text);
}

/** @param {HTMLTableRowElement} first @param {HTMLTableRowElement} second @param {number} column @param {number} sign */
function compare(first, second, column, sign) {
  const [one, other] = [valueOf(first, column), valueOf(second, column)];
  if (one === null || other === null) return Number(one === null) - Number(other === null);
  if (typeof one === "number" && typeof other === "number") return sign * (one - other);
  return sign * String(one).localeCompare(String(other));
}

/** @param {HTMLTableCellElement} head */
function sortBy(head) {
  const descending = head.getAttribute("aria-sort") === "ascending";
  for (const other of table.querySelectorAll("thead th")) other.removeAttribute("aria-sort");
  head.setAttribute("aria-sort", descending ? "descending" : "ascending");
  const rows = [...body.rows].sort((first, second) => compare(first, second, head.cellIndex, descending ? -1 : 1));
  body.append(...rows);
}

for (const head of /** @type {NodeListOf<HTMLTableCellElement>} */ (table.querySelectorAll("thead th"))) {
  head.querySelector("button")?.addEventListener("click", () => sortBy(head));
}
