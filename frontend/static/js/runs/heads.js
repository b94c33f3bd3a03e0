// @ts-check
import { byId, el } from "../dom.js";

/** @typedef {import("./cells.js").Column} Column */
/** @typedef {{sort: (key: string, descending: boolean) => void, filter: (column: Column) => void, order: (keys: string[]) => void}} Listener */

const NUMERIC = ["number", "time"];
let dragged = "";

/** Show the header cells: sort buttons and menus; drag or Shift with an arrow key moves a column.
 * @param {Column[]} columns @param {import("./view.js").View} view @param {Listener} listener */
export function showHeads(columns, view, listener) {
  const keys = columns.map((one) => one.key);
  const focused = document.activeElement instanceof HTMLElement ? document.activeElement.dataset.sort : "";
  const first = byId("heads").firstElementChild;
  byId("heads").replaceChildren(first, ...columns.map((column) => head(column, keys, view, listener)));
  if (focused) /** @type {HTMLElement | null} */ (document.querySelector(`[data-sort="${CSS.escape(focused)}"]`))?.focus();
}

/** @param {Column} column @param {string[]} keys @param {import("./view.js").View} view @param {Listener} listener */
function head(column, keys, view, listener) {
  const active = view.values.sort === column.key;
  const order = active ? (view.descending ? "descending" : "ascending") : "none";
  const mark = active ? el("span", { "aria-hidden": "true" }, view.descending ? " ▼" : " ▲") : "";
  const next = active ? !view.descending : NUMERIC.includes(column.kind);
  const [what, below] = inTwo(column);
  const sort = el("button", { type: "button", class: "sort", "data-sort": column.key, on: {
    click: () => listener.sort(column.key, next),
    keydown: (/** @type {KeyboardEvent} */ event) => {
      const by = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
      if (!event.shiftKey || !by) return;
      event.preventDefault();
      listener.order(moved(keys, column.key, by));
    },
  } }, el("span", { class: "what" }, what, mark), below && el("span", { class: "unit" }, below));
  const menu = el("button", { type: "button", class: "menu", "aria-label": `Menu of column ${column.label}`, "aria-haspopup": "menu", on: {
    click: () => openMenu(menu, column, keys, listener),
  } }, "⋮");
  const title = [column.group === "Plan" ? column.key : "", column.help].filter(Boolean).join(": ");
  return el("th", { scope: "col", class: `is-${column.kind}`, draggable: "true", title, "aria-sort": order, on: {
    dragstart: () => (dragged = column.key),
    dragover: (/** @type {DragEvent} */ event) => event.preventDefault(),
    drop: (/** @type {DragEvent} */ event) => {
      event.preventDefault();
      if (dragged) listener.order(dropped(keys, dragged, column.key));
      dragged = "";
    },
  } }, el("span", { class: "head" }, sort, menu));
}

/** What a column holds, and below it of which part and in which unit. @param {Column} column */
function inTwo({ label, group, unit }) {
  const at = group === "Plan" ? label.lastIndexOf(": ") : group.startsWith("Measures") ? label.indexOf(", ") : -1;
  if (at < 0) return [label, unit];
  const [first, second] = [label.slice(0, at), label.slice(at + 2)];
  const [what, part] = group === "Plan" ? [second, first] : [first, second];
  return [what, unit ? `${part}, ${unit}` : part];
}

/** @param {HTMLElement} button @param {Column} column @param {string[]} keys @param {Listener} listener */
function openMenu(button, column, keys, listener) {
  const menu = byId("head-menu");
  const close = () => {
    menu.hidePopover();
    button.focus();
  };
  const item = (/** @type {string} */ label, /** @type {() => void} */ act) =>
    el("button", { type: "button", role: "menuitem", on: { click: () => { close(); act(); } } }, label);
  menu.replaceChildren(
    item("Sort ascending", () => listener.sort(column.key, false)),
    item("Sort descending", () => listener.sort(column.key, true)),
    item("Filter this column", () => listener.filter(column)),
    item("Move left", () => listener.order(moved(keys, column.key, -1))),
    item("Move right", () => listener.order(moved(keys, column.key, 1))),
    ...(keys.length > 1 ? [item("Hide column", () => listener.order(keys.filter((key) => key !== column.key)))] : []),
  );
  const box = button.getBoundingClientRect();
  menu.style.top = `${box.bottom + 2}px`;
  menu.style.left = `${Math.max(4, Math.min(box.left, innerWidth - 200))}px`;
  menu.showPopover();
  menu.firstElementChild.focus();
  menu.onkeydown = (/** @type {KeyboardEvent} */ event) => {
    const items = [...menu.children];
    const at = items.indexOf(document.activeElement);
    const to = { ArrowDown: at + 1, ArrowUp: at - 1, Home: 0, End: items.length - 1 }[event.key];
    if (to === undefined) return;
    event.preventDefault();
    items[(to + items.length) % items.length].focus();
  };
}

/** @param {string[]} keys @param {string} key @param {number} by */
export function moved(keys, key, by) {
  const at = keys.indexOf(key);
  const to = Math.min(Math.max(at + by, 0), keys.length - 1);
  return keys.toSpliced(at, 1).toSpliced(to, 0, key);
}

/** @param {string[]} keys @param {string} key @param {string} onto */
function dropped(keys, key, onto) {
  const to = keys.indexOf(onto);
  return keys.filter((one) => one !== key).toSpliced(to, 0, key);
}
