// @ts-check
import { api, explain } from "../api.js";
import { el } from "../dom.js";
import { choiceField, keptField } from "./field.js";
import { part } from "./parts.js";
import { previewOf } from "./preview.js";
import { uploadBox } from "./upload.js";

/** @typedef {import("./field.js").Part} Part @typedef {import("./field.js").Node} Node @typedef {import("./schema.js").Schema} Schema */

/**
 * The ground motion: a record of the library with its preview, its scale, and a way to bring in a new record.
 * Acceleration that a plan carries itself is kept.
 * @param {Schema} schema @param {Node} node @param {any} value @param {any[]} records @returns {Part}
 */
export function motionPart(schema, node, value, records) {
  const inline = value?.kind === "inline" ? value : null;
  const record = schema.kinds(schema.resolve(node)).get(inline ? "inline" : "record") ?? {};
  const scale = part(schema, record.properties.scale, "motion.scale", value?.scale ?? schema.initial(record.properties.scale));
  if (inline) return inlinePart(record, inline, scale);

  const known = new Map(records.map((one) => [one.name, label(one)]));
  if (value?.record && !known.has(value.record)) known.set(value.record, `${value.record} (not in this library)`);
  const first = value?.record || records[0]?.name || "";
  const choice = choiceField("motion.record", record.properties.record.title, known, first);
  const shown = el("div", { "aria-live": "off" });

  const show = async () => {
    const name = choice.read();
    shown.replaceChildren(el("p", { class: "muted" }, "Reading the record …"));
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

  const element = el("div", { "data-path": "motion" }, choice.element, shown, uploadBox(added), scale.element);
  const read = () => {
    const name = choice.read();
    return { kind: "record", record: name, sha256: name === value?.record ? (value.sha256 ?? null) : null, scale: scale.read() };
  };
  return { element, read, problems: scale.problems };
}

/** @param {Node} node @param {any} value @param {Part} scale @returns {Part} */
function inlinePart(node, value, scale) {
  const kept = keptField(node.properties.acceleration, value.acceleration);
  const element = el("div", { "data-path": "motion" }, kept.element, scale.element);
  return { element, read: () => ({ ...value, scale: scale.read() }), problems: scale.problems };
}

/** @param {any} motion */
const label = (motion) => (motion.title && motion.title !== motion.name ? `${motion.title} (${motion.name})` : motion.name);
