// @ts-check
import { api, explain } from "../api.js";
import { byId, el } from "../dom.js";
import { about } from "./about.js";
import { tagList } from "./cells.js";
import { toast } from "./toast.js";

const id = byId("run").dataset.id;

/** Tags beside the name, and a banner where lists hide the run. @param {any} run */
function show(run) {
  byId("name").textContent = run.name;
  byId("tags").replaceChildren(...(run.tags.length ? [tagList(run.tags)] : []));
  const banner = byId("hidden-run");
  banner.hidden = !run.deleted_at && !run.archived;
  if (banner.hidden) return;
  const words = run.deleted_at ? "This run is deleted. Its recording is removed 7 days after the deletion." : "This run is archived: lists hide it.";
  const button = el("button", { type: "button", class: "quiet small", "data-needs": "engineer", on: { click: () => restore(run) } }, run.deleted_at ? "Restore run" : "Unarchive run");
  banner.replaceChildren(el("p", {}, words), button);
}

/** @param {any} run */
async function restore(run) {
  try {
    const next = run.deleted_at ? await api.post(`/runs/${id}/restore`) : await api.patch(`/runs/${id}`, { archived: false });
    show(Object.assign(run, next));
    toast(`Run #${run.number} is shown in lists again.`);
  } catch (error) {
    toast(`The run stays as it is: ${explain(error)}`, null, true);
  }
}

try {
  const [run, { tags }] = await Promise.all([api.get(`/runs/${id}`), api.get("/runs/tags")]);
  byId("about").replaceChildren(...about(run, tags, show));
  byId("about-fold").open = Boolean(run.notes);
  show(run);
} catch (error) {
  toast(explain(error), null, true);
}
