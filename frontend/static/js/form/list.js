// @ts-check
import { el } from "../dom.js";
import { kindLabel } from "./schema.js";

/** @typedef {import("./field.js").Part} Part @typedef {import("./field.js").Node} Node @typedef {import("./schema.js").Schema} Schema */

/**
 * A fold of an item: `element` is a `details` around the fields of the item, and `show` gives it the item's present value.
 * @typedef {{element: HTMLDetailsElement, show: (value: any) => void}} Fold
 */

/**
 * A list whose items can be added, duplicated and removed (stations, storeys). Some kinds of test use only the first item.
 * @param {Schema} schema @param {Node} node @param {string} path @param {any[]} values
 * @param {(schema: Schema, node: Node, path: string, value: any) => Part} part
 * @param {((fields: HTMLElement, index: number, open: boolean) => Fold) | null} fold of an item, for lists of long items
 * @returns {Part}
 */
export function listPart(schema, node, path, values, part, fold = null) {
  const item = schema.resolve(node.items);
  const name = node.item ?? (item.title ? kindLabel(item) : "Effect");
  const singular = name.toLowerCase();
  /** @type {Part[]} */
  let parts = [];
  /** @type {Fold[]} */
  let folds = [];
  const items = el("div", { class: "items" });
  const add = el("button", { type: "button", class: "quiet", on: { click: () => insert(parts.length, schema.initial(node.items)) } }, `Add ${/^[aeiou]/.test(singular) ? "an" : "a"} ${singular}`);

  const build = (/** @type {any[]} */ read, /** @type {boolean[]} */ open = []) => {
    parts = read.map((value, i) => part(schema, { ...item, title: `${name} ${i + 1}` }, `${path}.${i}`, value));
    const elements = parts.map((one, i) => withButtons(one.element, i));
    folds = fold ? elements.map((element, i) => fold(element, i, open[i] ?? false)) : [];
    items.replaceChildren(...(fold ? folds.map((one) => one.element) : elements));
    showFolds();
    add.disabled = parts.length >= (node.maxItems ?? Infinity);
  };
  const showFolds = () => folds.forEach((one, i) => one.show(parts[i].read()));
  const opened = () => folds.map((one) => one.element.open);
  const changed = () => items.dispatchEvent(new Event("input", { bubbles: true }));
  const insert = (/** @type {number} */ at, /** @type {any} */ value) => {
    const read = parts.map((one) => one.read());
    const open = opened();
    build([...read.slice(0, at), named(value, read), ...read.slice(at)], [...open.slice(0, at), true, ...open.slice(at)]);
    /** @type {HTMLElement | null} */ (items.children[at].querySelector("input, select"))?.focus();
    changed();
  };
  const remove = (/** @type {number} */ at) => {
    const others = (/** @type {any[]} */ list) => list.filter((_, i) => i !== at);
    build(others(parts.map((one) => one.read())), others(opened()));
    const next = items.children[Math.min(at, parts.length - 1)];
    /** @type {HTMLElement} */ (next?.querySelector(fold ? "summary" : "input, select") ?? add).focus();
    changed();
  };
  const withButtons = (/** @type {HTMLElement} */ element, /** @type {number} */ i) => {
    const button = (/** @type {string} */ verb, /** @type {() => void} */ click) =>
      el("button", { type: "button", class: "quiet small", "aria-label": `${verb} ${singular} ${i + 1}`, on: { click } }, verb);
    const removable = parts.length > (node.minItems ?? 0);
    element.append(
      el(
        "div",
        { class: "actions" },
        button("Duplicate", () => insert(i + 1, structuredClone(parts[i].read()))),
        removable && button("Remove", () => remove(i)),
      ),
    );
    return element;
  };

  const single = () => node.one_in?.includes(schema.test);
  const refresh = () => {
    if (single() && !parts.length) build([schema.initial(node.items)], [true]);
    showFolds();
    element.classList.toggle("single", Boolean(single()));
  };
  const used = () => (single() ? parts.slice(0, 1) : parts);

  build(values ?? []);
  const element = el("div", { class: "list", "data-path": path, tabindex: "-1" }, items, add, el("small", { id: `e-${path}`, class: "error" }));
  refresh();
  return { element, refresh, read: () => used().map((one) => one.read()), problems: () => used().flatMap((one) => one.problems()) };
}

/** A new item with a name that no other item has. @param {any} value @param {any[]} others */
function named(value, others) {
  if (!value || typeof value.name !== "string") return value;
  const taken = new Set(others.map((other) => other.name));
  const base = value.name.replace(/ \d+$/, "");
  let name = value.name;
  for (let n = 2; taken.has(name); n++) name = `${base} ${n}`;
  return { ...value, name };
}
