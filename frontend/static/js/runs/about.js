// @ts-check
import { api, explain } from "../api.js";
import { el } from "../dom.js";
import { may } from "../role.js";
import { toast } from "./toast.js";

/** Fields for what people say about a run: name, tags and notes. Each is stored when it is left.
 * @param {any} run @param {string[]} tags those that other runs have @param {(run: any) => void} changed @returns {HTMLElement[]} */
export function about(run, tags, changed) {
  const save = async (/** @type {HTMLInputElement | HTMLTextAreaElement} */ field, /** @type {Record<string, any>} */ change) => {
    try {
      Object.assign(run, await api.patch(`/runs/${run.id}`, change));
      field.removeAttribute("aria-invalid");
      toast(`Run #${run.number}: saved.`);
      changed(run);
    } catch (error) {
      field.setAttribute("aria-invalid", "true");
      toast(`Run #${run.number} is not changed: ${explain(error)}`, null, true);
    }
  };
  const disabled = !may("engineer");
  const name = el("input", { disabled, value: run.name, maxlength: 200, autocomplete: "off" });
  name.addEventListener("change", () => save(name, { name: name.value }));
  const words = el("input", { disabled, value: run.tags.join(", "), autocomplete: "off", placeholder: "calibration, paper", list: "known-tags" });
  words.addEventListener("change", () => save(words, { tags: words.value.split(",").map((/** @type {string} */ one) => one.trim()).filter(Boolean) }));
  const notes = el("textarea", { disabled, rows: 3, maxlength: 10_000, placeholder: "What a reader should know about this run" });
  notes.value = run.notes;
  notes.addEventListener("change", () => save(notes, { notes: notes.value }));
  const known = el("datalist", { id: "known-tags" }, ...tags.map((tag) => el("option", { value: tag })));
  const given = document.getElementById("known-tags");
  if (given) given.replaceChildren(...known.children);
  const field = (/** @type {string} */ label, /** @type {Node} */ input) => el("label", {}, label, input);
  return [field("Name", name), field("Tags, separated by commas", words), field("Notes", notes), el("p", { class: "muted", "data-lacks": "engineer" }, "Only an engineer changes name, tags and notes."), ...(given ? [] : [known])];
}
