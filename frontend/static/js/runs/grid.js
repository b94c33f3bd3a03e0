// @ts-check
import { byId, el } from "../dom.js";
import { shown } from "./cells.js";

/** @typedef {import("./cells.js").Column} Column */
/** @typedef {import("./cells.js").Row} Row */

/** The rows of the run table: the focused row, the selected rows, and the keys that move and select. */
export class Grid {
  /** @param {{focused: (row: Row, asked: boolean) => void, selected: () => void}} listener */
  constructor(listener) {
    this.listener = listener;
    /** @type {Row[]} */
    this.rows = [];
    /** @type {Map<string, Row>} */
    this.selection = new Map();
    this.current = "";
    const body = byId("rows");
    body.addEventListener("keydown", (/** @type {KeyboardEvent} */ event) => this.key(event));
    body.addEventListener("focusin", (/** @type {FocusEvent} */ event) => this.enter(event));
    body.addEventListener("click", (/** @type {MouseEvent} */ event) => this.click(event));
    body.addEventListener("change", (/** @type {Event} */ event) => this.tick(event));
    byId("select-all").addEventListener("change", () => this.all(byId("select-all").checked));
  }

  /** @param {Column[]} columns @param {Row[]} rows */
  show(columns, rows) {
    const had = byId("rows").contains(document.activeElement);
    this.rows = rows;
    if (!rows.some((row) => row.id === this.current)) this.current = rows[0]?.id ?? "";
    byId("rows").replaceChildren(...rows.map((row) => this.row(columns, row)));
    this.mark();
    if (had) this.focus(this.index);
  }

  get index() {
    return Math.max(0, this.rows.findIndex((row) => row.id === this.current));
  }

  /** @param {Column[]} columns @param {Row} row */
  row(columns, row) {
    const cells = columns.map((column, place) =>
      el("td", { class: `is-${column.kind} at-${column.key}`, "data-label": column.heading }, shown(column, row, row.cells[place])),
    );
    const tick = el("input", { type: "checkbox", tabindex: -1, "aria-label": `Select run #${row.number}` });
    return el("tr", { "data-id": row.id, tabindex: row.id === this.current ? 0 : -1 }, el("td", { class: "tick" }, tick), ...cells);
  }

  /** Show which rows are selected and which is focused. */
  mark() {
    for (const line of byId("rows").rows) {
      const chosen = this.selection.has(line.dataset.id);
      line.classList.toggle("selected", chosen);
      line.classList.toggle("current", line.dataset.id === this.current);
      line.tabIndex = line.dataset.id === this.current ? 0 : -1;
      line.querySelector(".tick input").checked = chosen;
    }
    const here = this.rows.filter((row) => this.selection.has(row.id)).length;
    byId("select-all").checked = here > 0 && here === this.rows.length;
    byId("select-all").indeterminate = here > 0 && here < this.rows.length;
  }

  /** @param {number} index */
  focus(index) {
    byId("rows").rows[Math.min(Math.max(index, 0), this.rows.length - 1)]?.focus();
  }

  /** @param {string} id @param {boolean} on */
  choose(id, on) {
    const row = this.rows.find((one) => one.id === id);
    if (on && row) this.selection.set(id, row);
    else this.selection.delete(id);
    this.mark();
    this.listener.selected();
  }

  /** @param {boolean} on */
  all(on) {
    for (const row of this.rows) {
      if (on) this.selection.set(row.id, row);
      else this.selection.delete(row.id);
    }
    this.mark();
    this.listener.selected();
  }

  clear() {
    this.selection.clear();
    this.mark();
    this.listener.selected();
  }

  /** @param {KeyboardEvent} event */
  key(event) {
    const line = /** @type {HTMLElement} */ (event.target);
    if (!line.matches("tr")) return;
    const moves = { ArrowDown: this.index + 1, ArrowUp: this.index - 1, Home: 0, End: this.rows.length - 1, PageDown: this.index + 10, PageUp: this.index - 10 };
    const to = moves[/** @type {keyof typeof moves} */ (event.key)];
    if (to !== undefined) {
      if (event.shiftKey) this.choose(this.current, true);
      this.focus(to);
      if (event.shiftKey) this.choose(this.current, true);
    } else if (event.key === " ") this.choose(this.current, !this.selection.has(this.current));
    else if (event.key === "Enter") location.assign(`/runs/${this.current}`);
    else if (event.key === "Escape") this.clear();
    else return;
    event.preventDefault();
  }

  /** @param {FocusEvent} event */
  enter(event) {
    const line = /** @type {Element} */ (event.target).closest("tr");
    if (line) this.to(line, false);
  }

  /** @param {MouseEvent} event */
  click(event) {
    const target = /** @type {Element} */ (event.target);
    const line = target.closest("tr");
    if (line && !target.closest("a, input")) {
      line.focus();
      this.to(line, true);
    }
  }

  /** @param {Event} event */
  tick(event) {
    const box = /** @type {HTMLInputElement} */ (event.target);
    this.choose(box.closest("tr")?.dataset.id ?? "", box.checked);
  }

  /** @param {HTMLElement} line @param {boolean} asked */
  to(line, asked) {
    const row = this.rows.find((one) => one.id === line.dataset.id);
    if (!row || (row.id === this.current && !asked && line.classList.contains("shown"))) return;
    this.current = row.id;
    for (const one of byId("rows").rows) one.classList.toggle("shown", one === line);
    this.mark();
    this.listener.focused(row, asked);
  }
}
