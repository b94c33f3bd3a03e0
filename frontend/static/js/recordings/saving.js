// @ts-check
import { api, explain } from "../api.js";
import { el } from "../dom.js";
import { labelled } from "../form/field.js";

/**
 * Saves the mapping under a name, for files of the same layout.
 * @param {string} file checksum of the file @param {() => any} mapping @param {() => string} who @param {(saved: any) => void} done @returns {HTMLElement}
 */
export function savingOf(file, mapping, who, done) {
  const name = el("input", { type: "text", maxlength: 200, autocomplete: "off" });
  const field = labelled("mapping.name", "Name of the mapping", name, "proposed again for files with the same format, column names and units");
  const told = el("p", { role: "status" });
  const error = field.querySelector("small.error");
  const save = async () => {
    error.textContent = told.textContent = "";
    try {
      const saved = await api.post("/mappings", { file, mapping: mapping(), name: name.value.trim(), saved_by: who() });
      told.textContent = `The mapping was saved as ${saved.name}.`;
      name.value = "";
      done(saved);
    } catch (refused) {
      error.textContent = explain(refused);
      name.focus();
    }
  };
  name.addEventListener("keydown", (/** @type {KeyboardEvent} */ event) => {
    if (event.key !== "Enter") return;
    event.preventDefault();
    save();
  });
  const button = el("button", { type: "button", class: "quiet", on: { click: save } }, "Save the mapping");
  return el("div", { class: "saving" }, el("div", { class: "starters sending" }, field, button), told);
}
