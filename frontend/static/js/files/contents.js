// @ts-check
import { el } from "../dom.js";
import { significant } from "../format.js";

/**
 * What stands in a file, as the service describes it.
 * @typedef {{what: string, where: string, stated: number, read: number, unit: string, agrees: boolean}} Stated
 * @typedef {{format: string, about: Record<string, string>, header: string, header_characters: number, statements: Stated[],
 *   first_rows: (number | null)[][]}} Contents
 */

const MOST_COLUMNS = 60;
const FEW_COLUMNS = 6; // the rows stand beside the header

/** The raw header, what it states beside what was read, and the first rows of numbers. @param {Contents} contents @param {string[]} names of the columns @returns {HTMLElement} */
export function contentsOf(contents, names) {
  const about = Object.entries(contents.about).filter(([, text]) => text);
  return el(
    "details",
    { class: "contents", open: true },
    el("summary", {}, "What stands in the file"),
    about.length > 0 && el("dl", { class: "facts" }, ...about.flatMap(([name, text]) => [el("dt", {}, name), el("dd", { title: text }, text)])),
    el("div", { class: "panes" }, ...headerPanes(contents), rowsPane(contents.first_rows, names)),
  );
}

/** @param {Contents} contents */
function headerPanes(contents) {
  const { header, statements } = contents;
  if (!header.trim() && !statements.length) return [el("p", { class: "wide muted" }, "No header text was read, and no stated number was compared with the data.")];
  return [headerPane(contents), statementsPane(statements)];
}

/** @param {Contents} contents */
function headerPane({ header, header_characters }) {
  const cut = header_characters - header.length;
  return pane(
    "Header of the file",
    header.trim() ? el("pre", { tabindex: "0", role: "region", "aria-label": "Header of the file" }, header) : el("p", { class: "muted" }, "No header text was read."),
    cut > 0 && el("p", { class: "muted" }, `${cut} more characters are not shown.`),
  );
}

/** @param {Stated[]} statements */
function statementsPane(statements) {
  if (!statements.length) return pane("What the header states", el("p", { class: "muted" }, "No stated number was compared with the data."));
  const rows = statements.map(({ what, where, stated, read, unit, agrees }) =>
    el(
      "tr",
      {},
      el("th", { scope: "row" }, unit ? `${what}, ${unit}` : what),
      el("td", { class: "muted" }, where),
      el("td", { class: "number" }, plain(stated)),
      el("td", { class: "number" }, plain(read)),
      el("td", { class: agrees ? "agrees" : "differs" }, agrees ? "agrees" : "differs"),
    ),
  );
  const heads = [["Quantity"], ["Where"], ["Stated", "number"], ["Read", "number"], ["Result"]];
  return pane("What the header states, beside what was read", table("What the header states", heads, rows, "stated"));
}

/** @param {(number | null)[][]} rows @param {string[]} names */
function rowsPane(rows, names) {
  const shown = names.slice(0, MOST_COLUMNS);
  const lines = rows.map((row, k) => el("tr", {}, el("th", { scope: "row", class: "number" }, String(k + 1)), ...shown.map((_, at) => el("td", { class: "number" }, plain(row[at])))));
  const heads = [["Row", "number"], ...shown.map((name) => [name, "number"])];
  const rest = names.length - shown.length;
  const said = rest > 0 && el("p", { class: "muted" }, `${rest} more columns are not shown.`);
  return el("section", { class: names.length > FEW_COLUMNS ? "wide" : "" }, el("p", { class: "title" }, "First rows of numbers"), table("First rows of numbers", heads, lines), said);
}

/** @param {string} title @param {...any} children */
const pane = (title, ...children) => el("section", {}, el("p", { class: "title" }, title), ...children);

/** @param {string} label @param {string[][]} heads @param {HTMLElement[]} rows */
function table(label, heads, rows, kind = "") {
  const head = el("tr", {}, ...heads.map(([text, kind]) => el("th", { scope: "col", class: kind }, text)));
  return el("div", { class: `scroll ${kind}`, tabindex: "0", role: "region", "aria-label": label }, el("table", {}, el("thead", {}, head), el("tbody", {}, ...rows)));
}

/** A number as it was read, at most nine digits; a dash where there is none. @param {number | null | undefined} value */
const plain = (value) => (value == null ? "–" : significant(value, 9));
