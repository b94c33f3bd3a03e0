// @ts-check
import { el } from "../dom.js";
import { choiceField, numbersField, scalarField, switchField } from "./field.js";
import { listPart } from "./list.js";
import { matrixField } from "./matrix.js";
import { hintOf, kindLabel } from "./schema.js";

/** @typedef {import("./field.js").Part} Part @typedef {import("./field.js").Node} Node @typedef {import("./schema.js").Schema} Schema */

/** The part of the form for one node of the schema. @param {Schema} schema @param {Node} unresolved @param {string} path @param {any} value @returns {Part} */
export function part(schema, unresolved, path, value) {
  const node = schema.resolve(unresolved);
  if (node.oneOf) return node.folded ? foldedPart(schema, node, path, value) : unionPart(schema, node, path, value);
  if (node.type === "object") return groupPart(schema, node, path, value, node.title);
  if (node.type === "array") {
    if (node.items.$ref) return listPart(schema, node, path, value, part);
    if (node.items.oneOf) return effectsPart(schema, node, path, value);
    return node.items.type === "array" ? matrixField(node, path, value) : numbersField(node, path, value);
  }
  if (node.type === "boolean") return switchField(node, path, value);
  if (node.enum) {
    const choices = new Map(node.enum.map((/** @type {string} */ one) => [one, node.titles?.[one] ?? one]));
    return choiceField(path, node.title, choices, value, hintOf(node), Boolean(node.titles));
  }
  return scalarField(node, path, value);
}

/**
 * The fields of an object. `kind` has no field and is read back unchanged. A field that the kind of test does not use is hidden
 * and gives its default; the typed text is kept.
 * @param {Schema} schema @param {Node} node @param {string} path @param {any} value
 */
export function fieldsOf(schema, node, path, value) {
  const names = Object.keys(node.properties).filter((name) => name !== "kind");
  const fields = names.map((name) => {
    const property = node.properties[name];
    return usedIn(schema, property, part(schema, property, path ? `${path}.${name}` : name, value?.[name]));
  });
  const kind = node.properties.kind ? { kind: node.properties.kind.const } : {};
  return {
    elements: fields.map((one) => one.element),
    read: () => ({ ...kind, ...Object.fromEntries(names.map((name, i) => [name, fields[i].read()])) }),
    problems: () => fields.flatMap((one) => one.problems()),
  };
}

/** A part that is shown and read while the selected kind of test uses it. @param {Schema} schema @param {Node} node @param {Part} one @returns {Part} */
export function usedIn(schema, node, one) {
  if (!node.tests) return one;
  one.element.dataset.tests = node.tests.join(" ");
  one.element.hidden = !schema.applies(node);
  return {
    ...one,
    read: () => (schema.applies(node) ? one.read() : schema.initial(node)),
    problems: () => (schema.applies(node) ? one.problems() : []),
  };
}

/** Fields of an object under a heading. @param {Schema} schema @param {Node} node @param {string} path @param {any} value @param {string} title @returns {Part} */
function groupPart(schema, node, path, value, title) {
  const fields = fieldsOf(schema, node, path, value);
  const heading = node.properties.kind && title !== kindLabel(node) ? `${title}: ${kindLabel(node)}` : title;
  const element = el("fieldset", { class: "group", "data-path": path }, el("legend", { class: path.includes(".") ? "" : "unseen" }, heading), el("div", { class: "fields" }, ...fields.elements));
  return { element, read: fields.read, problems: fields.problems };
}

/** A list of effects, each a choice of kinds, under a heading. @param {Schema} schema @param {Node} node @param {string} path @param {any} value @returns {Part} */
function effectsPart(schema, node, path, value) {
  const list = listPart(schema, node, path, value, part);
  const element = el("fieldset", { class: "group effects" }, el("legend", {}, node.title), list.element);
  return { ...list, element };
}

/** A choice of kinds behind a line that says which kind it is: most plans keep the first. @param {Schema} schema @param {Node} node @param {string} path @param {any} value @returns {Part} */
function foldedPart(schema, node, path, value) {
  const made = unionPart(schema, node, path, value);
  const kinds = schema.kinds(node);
  const initial = [...kinds.keys()][0];
  const chosen = el("span", { class: "subfold-kind" });
  const show = () => (chosen.textContent = kindLabel(/** @type {Node} */ (kinds.get(made.read().kind))));
  const open = (value?.kind ?? initial) !== initial;
  const element = el("details", { class: "subfold", open }, el("summary", {}, `${node.title}: `, chosen), made.element);
  element.addEventListener("change", show);
  show();
  return { ...made, element };
}

/** A choice of kinds with the fields of the selected kind. The text typed for a kind is kept while another kind is selected. @param {Schema} schema @param {Node} node @param {string} path @param {any} value @returns {Part} */
function unionPart(schema, node, path, value) {
  const kinds = schema.kinds(node);
  const first = value?.kind ?? [...kinds.keys()][0];
  const labels = new Map([...kinds].map(([kind, option]) => [kind, kindLabel(option)]));
  const choice = choiceField(`${path}.kind`, node.title, labels, first);
  const body = el("div", { class: "fields" });
  /** @type {Map<string, ReturnType<typeof fieldsOf>>} */
  const made = new Map();
  const selected = () => /** @type {Node} */ (kinds.get(choice.read()));
  const current = () => {
    const kind = choice.read(); // read before `select` when the form hears the same input
    const fields = made.get(kind) ?? fieldsOf(schema, selected(), path, kind === value?.kind ? value : schema.initial(selected()));
    made.set(kind, fields);
    return fields;
  };
  const hint = el("small", { class: "hint" });
  const select = () => {
    body.replaceChildren(choice.element, ...current().elements);
    hint.textContent = hintOf(selected());
  };
  choice.control.addEventListener("change", () => {
    select();
    choice.control.focus();
  });
  select();
  choice.element.append(hint);
  const element = el("fieldset", { class: "group union", "data-path": path }, el("legend", { class: "unseen" }, node.title), body);
  return { element, read: () => current().read(), problems: () => current().problems() };
}
