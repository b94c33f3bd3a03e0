// @ts-check
import { api, explain } from "../api.js";
import { el } from "../dom.js";
import { choiceField, keptField } from "./field.js";
import { part } from "./parts.js";
import { previewOf } from "./preview.js";
import { kindLabel } from "./schema.js";
import { uploadBox } from "./upload.js";

/** @typedef {import("./field.js").Part} Part @typedef {import("./field.js").Node} Node @typedef {import("./schema.js").Schema} Schema */

/**
 * The ground motion: none, a record of the library, or an acceleration written in the plan, which is kept unchanged.
 * @param {Schema} schema @param {Node} unresolved @param {any} value @param {any[]} records @returns {Part}
 */
export function motionPart(schema, unresolved, value, records) {
  const node = schema.resolve(unresolved);
  const kinds = schema.kinds(node);
  const first = value?.kind === "none" || value?.kind === "inline" ? value.kind : "record"; // only the command line uses record files
  const offered = [...kinds].filter(([kind]) => kind === "record" || kind === "none" || kind === first);
  const choice = choiceField("motion.kind", node.title, new Map(offered.map(([kind, option]) => [kind, kindLabel(option)])), first);
  const body = el("div", {});
  const makers = {
    record: () => recordPart(schema, /** @type {Node} */ (kinds.get("record")), value?.kind === "record" ? value : {}, records),
    inline: () => inlinePart(schema, /** @type {Node} */ (kinds.get("inline")), value),
    none: () => ({ element: el("div", {}), read: () => ({ kind: "none" }), problems: () => [] }),
  };
  /** @type {Map<string, Part>} */
  const made = new Map();
  const current = () => /** @type {Part} */ (made.get(choice.read()));
  const select = () => {
    const kind = /** @type {keyof typeof makers} */ (choice.read());
    if (!made.has(kind)) made.set(kind, makers[kind]());
    body.replaceChildren(current().element);
  };
  choice.control.addEventListener("change", select);
  select();
  const element = el("div", { "data-path": "motion" }, choice.element, body);
  return { element, read: () => current().read(), problems: () => current().problems() };
}

/** A record with its preview, its scaling and the upload of a new record. @param {Schema} schema @param {Node} node @param {any} value @param {any[]} records @returns {Part} */
function recordPart(schema, node, value, records) {
  const scale = scalePart(schema, node, value);
  const known = new Map(records.map((one) => [one.name, label(one)]));
  if (value.record && !known.has(value.record)) known.set(value.record, `${value.record} (not in this library)`);
  const first = value.record || records[0]?.name || "";
  const choice = choiceField("motion.record", node.properties.record.title, known, first);
  const shown = el("div", { "aria-live": "off" });

  const show = async () => {
    const name = choice.read();
    shown.style.minHeight = `${shown.offsetHeight}px`; // so that the fields below stay where they are
    shown.replaceChildren(el("p", { class: "muted" }, "Loading the record …"));
    try {
      const preview = await api.get(`/motions/${encodeURIComponent(name)}/preview`);
      if (name === choice.read()) shown.replaceChildren(previewOf(preview));
    } catch (error) {
      shown.replaceChildren(el("p", { class: "error" }, explain(error)));
    }
  };
  const added = (/** @type {any} */ motion) => {
    choice.control.append(el("option", { value: motion.name }, label(motion)));
    choice.control.value = motion.name;
    choice.control.dispatchEvent(new Event("change", { bubbles: true }));
    choice.control.focus();
  };
  choice.control.addEventListener("change", show);
  if (first) show();

  const element = el("div", {}, choice.element, shown, uploadBox(added), scale.element);
  const read = () => {
    const name = choice.read();
    return { kind: "record", record: name, sha256: name === value.record ? (value.sha256 ?? null) : null, scale: scale.read() };
  };
  return { element, read, problems: scale.problems };
}

/** @param {Schema} schema @param {Node} node @param {any} value @returns {Part} */
function inlinePart(schema, node, value) {
  const scale = scalePart(schema, node, value);
  const kept = keptField(node.properties.acceleration, value.acceleration);
  const element = el("div", {}, kept.element, scale.element);
  return { element, read: () => ({ ...value, scale: scale.read() }), problems: scale.problems };
}

/** @param {Schema} schema @param {Node} node @param {any} value */
const scalePart = (schema, node, value) =>
  part(schema, node.properties.scale, "motion.scale", value.scale ?? schema.initial(node.properties.scale));

/** @param {any} motion */
const label = (motion) => (motion.title && motion.title !== motion.name ? `${motion.title} (${motion.name})` : motion.name);
