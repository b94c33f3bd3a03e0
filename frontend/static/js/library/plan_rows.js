// @ts-check
import { api } from "../api.js";
import { el } from "../dom.js";
import { person } from "../person.js";
import { attempt, notice } from "./notice.js";
import { queueVersion } from "./queue_dialog.js";
import { minute, rowButton } from "./words.js";

/**
 * @typedef {{number: number, name: string, test: string, digest: string, saved_by: string, saved_at: string, comment: string, runs: number}} Version
 * @typedef {{id: string, name: string, tags: string[], changed_at: string, archived_at: string | null, archived_by: string | null,
 *   versions: number, runs: number, drafts: number, newest: Version}} Plan
 */

/** The kinds of test as lists name them. @type {Record<string, string>} */
const KINDS = { structure: "structure alone" };

/** @param {string} test */
export const kindOf = (test) => KINDS[test] ?? test;

/** A row of the list of plans. @param {Plan} plan @param {() => Promise<void>} refresh shows the list anew @param {(tag: string) => void} filter */
export function planRow(plan, refresh, filter) {
  const { id, name, tags, newest, runs, drafts } = plan;
  const tagButtons = tags.map((tag) => el("button", { type: "button", class: "tag", "aria-label": `Show plans with the tag ${tag}`, on: { click: () => filter(tag) } }, tag));
  return el(
    "tr",
    {},
    el("td", { class: "name", "data-label": "Plan" }, el("a", { href: `/plans/${id}`, title: name }, name), tags.length > 0 && el("span", { class: "tags" }, ...tagButtons)),
    el("td", { class: "comment", "data-label": "Newest version" }, el("strong", {}, `Version ${newest.number}`), newest.comment && `: ${newest.comment}`),
    el("td", { "data-label": "Kind of test" }, kindOf(newest.test)),
    el("td", { "data-label": "Author" }, newest.saved_by),
    el("td", { class: "nowrap", "data-label": "Changed" }, minute(plan.changed_at)),
    el("td", { class: "number", "data-label": "Runs" }, String(runs || "–")),
    el("td", { class: "number", "data-label": "Drafts" }, String(drafts || "–")),
    el("td", {}, el("span", { class: "actions" }, ...(plan.archived_at ? [unarchive(plan, refresh)] : acts(plan, refresh)))),
  );
}

/** @param {Plan} plan @param {() => Promise<void>} refresh */
function acts({ id, name, versions }, refresh) {
  return [
    el("a", { class: "button quiet small", href: `/new?library=${id}`, "aria-label": `Open ${name} in the form` }, "Open"),
    rowButton("Queue", name, () => attempt(() => queueVersion(id, name, versions)), "operator"),
    rowButton("Duplicate", name, () => attempt(() => duplicate(id, refresh)), "engineer"),
    rowButton("Archive", name, () => attempt(() => archive(id, name, refresh)), "engineer"),
  ];
}

/** @param {string} id @param {() => Promise<void>} refresh */
async function duplicate(id, refresh) {
  const copy = await api.post(`/library/plans/${id}/duplicate`, { saved_by: person() });
  await refresh();
  notice(`Duplicated as ${copy.name}.`);
}

/** @param {string} id @param {string} name @param {() => Promise<void>} refresh */
export async function archive(id, name, refresh) {
  await api.post(`/library/plans/${id}/archive`, { by: person() });
  await refresh();
  notice(`${name} archived. All its versions stay stored.`, async () => {
    await api.post(`/library/plans/${id}/unarchive`);
    await refresh();
    notice(`${name} is in the library again.`);
  });
}

/** @param {Plan} plan @param {() => Promise<void>} refresh */
function unarchive({ id, name }, refresh) {
  const act = async () => {
    await api.post(`/library/plans/${id}/unarchive`);
    await refresh();
    notice(`${name} is in the library again.`);
  };
  return rowButton("Unarchive", name, () => attempt(act), "engineer");
}
