// @ts-check
import { api } from "../api.js";
import { byId, el } from "../dom.js";
import { person } from "../person.js";
import { showDifferences } from "./diff.js";
import { attempt, notice } from "./notice.js";
import { queueVersion } from "./queue_dialog.js";
import { showRuns } from "./runs_from.js";
import { minute } from "./words.js";
import { versionTable } from "./versions.js";

/** @typedef {import("./plan_rows.js").Plan & {created_by: string, created_at: string, history: import("./plan_rows.js").Version[]}} Detail */

const { id } = byId("kept-plan").dataset;
const path = `/library/plans/${id}`;

async function refresh() {
  await show(await api.get(path));
}

/** @param {Detail} plan */
async function show(plan) {
  document.title = `${plan.name} · RTHS control room`;
  byId("name").textContent = plan.name;
  byId("facts").replaceChildren(...facts(plan));
  byId("rename").value = plan.name;
  byId("tags").value = plan.tags.join(", ");
  byId("open").href = `/new?library=${id}`;
  byId("archive").textContent = plan.archived_at ? "Unarchive the plan" : "Archive the plan";
  byId("archive").onclick = () => attempt(() => archive(plan));
  byId("queue").onclick = () => attempt(() => queueVersion(plan.id, plan.name, plan.versions));
  byId("versions").replaceChildren(versionTable(plan, (first, second) => attempt(() => compare(first, second))));
  await showRuns(plan);
}

/** @param {Detail} plan */
function facts({ created_by, created_at, archived_at, archived_by, versions, runs, drafts, tags }) {
  const many = (/** @type {number} */ count, /** @type {string} */ what) => `${count} ${what}${count === 1 ? "" : "s"}`;
  const said = [many(versions, "version"), many(runs, "run"), many(drafts, "open draft"), `created by ${created_by}, ${minute(created_at)}`];
  if (archived_at) said.push(`archived by ${archived_by}, ${minute(archived_at)}`);
  return [el("span", {}, said.join(" · ")), ...tags.map((tag) => el("a", { class: "tag", href: `/plans?tag=${encodeURIComponent(tag)}` }, tag))];
}

/** @param {number} first @param {number} second */
async function compare(first, second) {
  await showDifferences(`version:${id}:${first}`, `version:${id}:${second}`);
  byId("differences-title").focus();
}

/** @param {Detail} plan */
async function archive({ archived_at, name }) {
  await api.post(`${path}/${archived_at ? "unarchive" : "archive"}`, archived_at ? {} : { by: person() });
  await refresh();
  if (archived_at) return notice(`${name} is in the library again.`);
  notice(`${name} archived. All its versions stay stored.`, async () => {
    await api.post(`${path}/unarchive`);
    await refresh();
    notice(`${name} is in the library again.`);
  });
}

async function change() {
  const tags = byId("tags").value.split(",").map((/** @type {string} */ tag) => tag.trim());
  await show(await api.patch(path, { name: byId("rename").value, tags: tags.filter(Boolean) }));
  byId("change").open = false;
  notice("Name and tags saved.");
}

async function duplicate() {
  const copy = await api.post(`${path}/duplicate`, { saved_by: person() });
  location.assign(`/plans/${copy.id}`);
}

byId("change-form").addEventListener("submit", (/** @type {Event} */ event) => {
  event.preventDefault();
  attempt(change);
});
byId("duplicate").addEventListener("click", () => attempt(duplicate));
attempt(refresh);
