// @ts-check
import { api, explain } from "../api.js";
import { byId, el } from "../dom.js";
import { when } from "../format.js";

/** @typedef {{id: string, name: string, format: string, columns: {name: string}[], saved_by: string, saved_at: string}} Saved */

const HEADS = ["Mapping", "Layout: format and columns", "Saved by", "Saved", "Download", ""];

/** Show the saved mappings in #saved, with rename and delete, and offer them for many files. */
export async function showSaved() {
  const host = byId("saved");
  try {
    const { mappings } = await api.get("/mappings");
    offer(mappings);
    host.replaceChildren(mappings.length ? table(mappings) : el("p", { class: "empty" }, "There is no saved mapping yet.", el("span", { "data-needs": "engineer" }, " Choose a file above, complete its mapping, and save it under a name.")));
  } catch (error) {
    host.replaceChildren(el("p", { class: "note bad", role: "alert" }, explain(error)));
  }
}

/** Offer the mappings in #many-mapping; a chosen mapping stays chosen while it exists. @param {Saved[]} mappings */
function offer(mappings) {
  const list = byId("many-mapping");
  const { value } = list;
  byId("many-saved").replaceChildren(...mappings.map(({ id, name }) => el("option", { value: `/mappings/${id}` }, name)));
  list.value = [...list.options].some((one) => one.value === value) ? value : "";
  list.dispatchEvent(new Event("change"));
}

/** @param {Saved[]} mappings */
function table(mappings) {
  const head = el("tr", {}, ...HEADS.map((text) => el("th", { scope: "col" }, text || el("span", { class: "unseen" }, "Rename and delete"))));
  return el(
    "div",
    { class: "scroll", tabindex: "0", role: "region", "aria-label": "Table of the saved mappings" },
    el("table", {}, el("thead", {}, head), el("tbody", {}, ...mappings.map(row))),
  );
}

/** @param {Saved} saved */
function row(saved) {
  const { id, name, format, columns, saved_by, saved_at } = saved;
  const layout = `${format}: ${columns.map((column) => column.name).join(", ")}`;
  const cell = el("td", { class: "name" }, name);
  const button = (/** @type {string} */ verb, /** @type {() => void} */ click) => el("button", { type: "button", class: "quiet small", "aria-label": `${verb} mapping ${name}`, on: { click } }, verb);
  return el(
    "tr",
    {},
    cell,
    el("td", { class: "name layout", title: layout }, layout),
    el("td", {}, saved_by),
    el("td", { class: "nowrap" }, when(saved_at)),
    el("td", {}, el("a", { href: `/api/v1/mappings/${id}/mapping.yaml`, "aria-label": `Mapping ${name}, YAML` }, "YAML")),
    el("td", {}, el("span", { class: "actions", "data-needs": "engineer" }, button("Rename", () => rename(saved, cell)), button("Delete", () => remove(saved)))),
  );
}

/** Replace the name by a field. Enter renames, Escape leaves the name. @param {Saved} saved @param {HTMLElement} cell */
function rename({ id, name }, cell) {
  const field = el("input", { type: "text", maxlength: 200, "aria-label": `New name of mapping ${name}`, autocomplete: "off" });
  const wrong = el("small", { class: "error", role: "alert" });
  field.value = name;
  const save = async () => {
    try {
      await api.patch(`/mappings/${id}`, { name: field.value.trim() });
      await showSaved();
    } catch (error) {
      wrong.textContent = explain(error);
      field.focus();
    }
  };
  field.addEventListener("keydown", (/** @type {KeyboardEvent} */ event) => {
    if (event.key === "Enter") save();
    if (event.key === "Escape") cell.replaceChildren(name);
  });
  cell.replaceChildren(el("span", { class: "renaming" }, field, el("button", { type: "button", class: "small", on: { click: save } }, "Save name")), wrong);
  field.select();
}

/** @param {Saved} saved */
async function remove({ id, name }) {
  if (!confirm(`Delete the saved mapping ${name}? Recordings that were imported by it stay as they are.`)) return;
  try {
    await api.remove(`/mappings/${id}`);
  } catch (error) {
    byId("refusal").textContent = explain(error);
  }
  await showSaved();
}
