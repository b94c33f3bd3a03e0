// @ts-check
import { api, explain } from "../api.js";
import { byId, el } from "../dom.js";
import { person } from "../person.js";
import { toast } from "./toast.js";

/** @typedef {{id: number, name: string, query: string, saved_by: string}} Saved */

/** The menu of saved views, and the dialog that saves the present one. @param {() => import("./view.js").View} present @param {(query: string) => void} opened */
export async function savedViews(present, opened) {
  /** @type {Saved[]} */
  let views = [];
  const select = byId("view");

  function show() {
    const query = present().saved;
    const same = views.find((one) => one.query === query);
    select.replaceChildren(
      el("option", { value: "", selected: !same && !query }, "All runs"),
      ...(!same && query ? [el("option", { value: query, selected: true }, "Not saved")] : []),
      ...views.map((one) => el("option", { value: one.query, selected: one === same }, one.name)),
    );
    byId("view-delete").hidden = !same;
  }

  async function load() {
    views = (await api.get("/runs/views")).views;
    show();
  }

  select.addEventListener("change", () => opened(select.value));
  byId("view-save").addEventListener("click", () => {
    byId("view-name").value = views.find((one) => one.query === present().saved)?.name ?? "";
    byId("view-dialog").showModal();
  });
  byId("view-form").addEventListener("submit", async () => {
    try {
      await api.post("/runs/views", { name: byId("view-name").value, query: present().saved, by: person() });
      await load();
      toast(`View “${byId("view-name").value.trim()}” saved.`);
    } catch (error) {
      toast(`The view is not saved: ${explain(error)}`, null, true);
    }
  });
  byId("view-delete").addEventListener("click", async () => {
    const one = views.find((view) => view.query === present().saved);
    if (!one) return;
    try {
      await api.remove(`/runs/views/${one.id}`);
      await load();
      const back = async () => {
        await api.post("/runs/views", { name: one.name, query: one.query, by: one.saved_by });
        await load();
      };
      toast(`View “${one.name}” deleted. Runs stay as they are.`, () => void back());
    } catch (error) {
      toast(`The view is not deleted: ${explain(error)}`, null, true);
    }
  });
  await load();
  return show;
}
