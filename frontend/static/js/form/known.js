// @ts-check
import { el } from "../dom.js";
import { choiceField } from "./field.js";

/** @typedef {import("./field.js").Part} Part @typedef {import("./field.js").Node} Node @typedef {import("./schema.js").Schema} Schema */

const OF_STRUCTURE = new Map([
  ["structure.mass", "Floor masses"],
  ["structure.stiffness", "Storey stiffnesses"],
  ["structure.damping", "Damping"],
]);
const OF_STATION = new Map([
  ["actuator", "Actuator"],
  ["specimen", "Specimen"],
  ["clock", "Delay between displacement and force channel"],
]);

/**
 * How well the numbers of the plan are known: a choice for each quantity of the structure and for each section of a station.
 * Statements about single numbers, which only YAML can give, are kept unchanged.
 * @param {Schema} schema @param {Node} node @param {Record<string, string>} value
 * @param {() => {name: string}[]} stations gives the stations that the form has now
 * @returns {Part}
 */
export function knownPart(schema, node, value, stations) {
  const choices = new Map([["", "Not stated"], .../** @type {[string, string][]} */ (Object.entries(node.titles))]);
  const fields = el("div", { class: "fields" });
  const element = el("fieldset", { class: "group", "data-path": "known" }, el("legend", { class: "unseen" }, node.title), el("p", { class: "hint" }, node.description), fields);
  let given = { ...value };
  /** @type {Map<string, ReturnType<typeof choiceField>>} */
  let selects = new Map();
  /** @type {string[]} */
  let names = [];
  let shown = "";

  const tested = () => (schema.test === "structure" ? [] : stations().map((one) => one.name));
  const rows = (/** @type {string[]} */ of) => {
    const own = of.flatMap((name, i) => [...OF_STATION].map(([section, label]) => [`stations.${i}.${section}`, of.length > 1 ? `${name}: ${label}` : label]));
    return new Map(/** @type {[string, string][]} */ (schema.test === "structure" ? [...OF_STRUCTURE] : own));
  };
  const stated = () => {
    const kept = Object.entries(given).filter(([path]) => !selects.has(path));
    const selected = [...selects].map(([path, select]) => [path, select.read()]);
    return Object.fromEntries([...selected, ...kept].filter(([, how]) => how));
  };
  const refresh = () => {
    const now = tested();
    const wanted = rows(now);
    if (JSON.stringify([...wanted]) === shown) return;
    given = shown ? moved(stated(), names, now) : given;
    names = now;
    shown = JSON.stringify([...wanted]);
    selects = new Map([...wanted].map(([path, label]) => [path, choiceField(`known.${path}`, label, choices, given[path] ?? "")]));
    fields.replaceChildren(...[...selects.values()].map((one) => one.element));
    element.hidden = !wanted.size;
  };
  const read = () => {
    const used = schema.test === "structure" ? "structure." : "stations.";
    return Object.fromEntries(Object.entries(stated()).filter(([path]) => path.startsWith(used)));
  };
  refresh();
  return { element, read, refresh, problems: () => [] };
}

/**
 * The statements after stations were added, removed or renamed. A station is known again by its name, or, after a change of
 * its name, by its place.
 * @param {Record<string, string>} given @param {string[]} before @param {string[]} after names of the stations
 */
function moved(given, before, after) {
  const from = after.map((name, i) => (before.includes(name) ? before.indexOf(name) : before.length === after.length ? i : -1));
  const found = Object.entries(given).flatMap(([path, how]) => {
    const [, index, rest] = /^stations\.(\d+)\.(.*)$/.exec(path) ?? [];
    if (index === undefined || !after.length) return [[path, how]];
    return from.flatMap((old, i) => (old === Number(index) ? [[`stations.${i}.${rest}`, how]] : []));
  });
  return Object.fromEntries(found);
}
