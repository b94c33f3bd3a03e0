// @ts-check
import { api } from "../api.js";
import { el } from "../dom.js";
import { person } from "../person.js";
import { release } from "./held_here.js";
import { attempt, notice } from "./notice.js";
import { ownDrafts } from "./own_drafts.js";
import { addressOf, problemsOf, rowButton, savedAt, tableOf } from "./words.js";

/** @typedef {import("./own_drafts.js").Listed} Listed */

/** Show the drafts of this person in the host. @param {HTMLElement} host */
export async function showDrafts(host) {
  const drafts = await ownDrafts(person());
  if (!drafts.length) {
    host.replaceChildren(el("p", { class: "empty" }, "You have no draft. What you type on the page New test is saved here as you type, valid or not."));
    return;
  }
  const rows = drafts.map((one) => row(one, () => showDrafts(host)));
  host.replaceChildren(tableOf("Table of your drafts", ["Draft", "Started from", "Check of the plan", "Saved", ""], rows));
}

/** @param {Listed} draft @param {() => Promise<void>} refresh */
function row(draft, refresh) {
  const { id, name, origin, origin_title, problems, saved_at, onlyHere } = draft;
  const title = name || "Without a name";
  return el(
    "tr",
    {},
    el("td", { class: "name", "data-label": "Draft" }, el("a", { href: `/new?draft=${id}` }, title)),
    el("td", { class: "name", "data-label": "Started from" }, origin ? el("a", { href: addressOf(origin) }, origin_title || `${origin.kind} ${origin.id}`) : "–"),
    el("td", { class: "problems", "data-label": "Check of the plan" }, onlyHere ? "Only this browser holds it: open it to save it" : problemsOf(problems)),
    el("td", { class: "nowrap", "data-label": "Saved" }, savedAt(saved_at)),
    el("td", {}, el("span", { class: "actions" }, rowButton("Discard", `the draft ${title}`, () => attempt(() => discard(draft, title, refresh)), "engineer"))),
  );
}

/** @param {Listed} draft @param {string} title @param {() => Promise<void>} refresh */
async function discard({ id, onlyHere }, title, refresh) {
  if (onlyHere && !confirm(`Discard the draft ${title}? Only this browser holds it: you cannot undo this.`)) return;
  release(id);
  if (!onlyHere) await api.post(`/library/drafts/${id}/close`, { closed_as: "discarded" });
  await refresh();
  const restore = async () => {
    await api.post(`/library/drafts/${id}/reopen`);
    await refresh();
    notice(`Draft ${title} restored.`);
  };
  notice(`Draft ${title} discarded.`, onlyHere ? undefined : restore);
}
