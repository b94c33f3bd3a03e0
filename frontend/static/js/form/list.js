// @ts-check
import { el } from "../dom.js";
import { kindLabel } from "./schema.js";

/** @typedef {import("./field.js").Part} Part @typedef {import("./field.js").Node} Node @typedef {import("./schema.js").Schema} Schema */

/**
 * A list whose items can be added, duplicated and removed (stations, storeys). Some kinds of test use only the first item.
 * @param {Schema} schema @param {Node} node @param {string} path @param {any[]} values
 * @param {(schema: Schema, node: Node, path: string, value: any) => Part} part
 * @returns {Part}
 */
export function listPart(schema, node, path, values, part) {
  const item = schema.resolve(node.items);
  const name = item.title ? kindLabel(item) : "Effect";
  const singular = name.toLowerCase();
  /** @type {Part[]} */
  let parts = [];
  const items = el("div", { class: "items" });
  const add = el("button", { type: "button", class: "quiet", on: { click: () => insert(parts.length, schema.initial(node.items)) } }, `Add ${/^[aeiou]/.test(singular) ? "an" : "a"} ${singular}`);

  const build = (/** @type {any[]} */ read) => {
    parts = read.map((value, i) => part(schema, { ...item, title: `${name} ${i + 1}` }, `${path}.${i}`, value));
    items.replaceChildren(...parts.map((one, i) => withButtons(one.element, i)));
    add.disabled = parts.length >= (node.maxItems ?? Infinity);
  };
  const changed = () => items.dispatchEvent(new Event("input", { bubbles: true }));
  const insert = (/** @type {number} */ at, /** @type {any} */ value) => {
    const read = parts.map((one) => one.read());
    build([...read.slice(0, at), named(value, read), ...read.slice(at)]);
    items.children[at].querySelector("input, select")?.focus();
    changed();
  };
  const remove = (/** @type {number} */ at) => {
    build(parts.map((one) => one.read()).filter((_, i) => i !== at));
    (items.children[Math.min(at, parts.length - 1)]?.querySelector("input, select") ?? add).focus();
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
    if (single() && !parts.length) build([schema.initial(node.items)]);
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
