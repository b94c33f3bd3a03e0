// @ts-check
import { api } from "../api.js";
import { el } from "../dom.js";
import { heldHere, heldIds, madeHere } from "./held_here.js";
import { savedAt } from "./words.js";

/**
 * A draft as the service lists it.
 * @typedef {{id: string, name: string, owner: string, saved_at: string, problems: import("./words.js").DraftProblem[],
 *   origin: import("./draft.js").Origin | null, origin_title: string, onlyHere?: boolean}} Listed
 */

/**
 * The open drafts of a person, last saved first. Without a name: the drafts that were made in this browser. Drafts that never
 * reached the service come first.
 * @param {string} name @returns {Promise<Listed[]>}
 */
export async function ownDrafts(name) {
  const { drafts } = await api.get(`/library/drafts?owner=${encodeURIComponent(name)}`);
  const known = new Set(madeHere());
  const own = /** @type {Listed[]} */ (drafts).filter((one) => name || known.has(one.id));
  const stored = new Set(own.map((one) => one.id));
  const here = heldIds().filter((id) => !stored.has(id) && !known.has(id));
  return [...here.map(onlyHere), ...own.map(asTyped)];
}

/** A draft under the name that this browser typed last: the save of a page that was left may still be under way. @param {Listed} draft @returns {Listed} */
function asTyped(draft) {
  const copy = heldHere(draft.id);
  return copy ? { ...draft, name: copy.plan?.name ?? "", saved_at: copy.at } : draft;
}

/** A draft that never reached the service. @param {string} id @returns {Listed} */
function onlyHere(id) {
  const { plan, origin, at } = /** @type {import("./held_here.js").Copy} */ (heldHere(id));
  return { id, name: plan?.name ?? "", owner: "", saved_at: at, problems: [], origin, origin_title: "", onlyHere: true };
}

/** Offer the drafts of a person above the form. @param {HTMLElement} host @param {string} name */
export async function offerDrafts(host, name) {
  const [newest, ...others] = await ownDrafts(name);
  if (!newest) return host.replaceChildren();
  const from = newest.origin_title && ` from ${newest.origin_title}`;
  host.replaceChildren(
    el(
      "p",
      { class: "banner" },
      el("span", {}, `You left a draft${from}, ${newest.onlyHere ? "held by this browser since" : "saved"} ${savedAt(newest.saved_at)}:`),
      el("a", { href: `/new?draft=${newest.id}` }, `Open the draft ${newest.name || "without a name"}`),
      others.length > 0 && el("a", { href: "/plans" }, `Show all ${others.length + 1} drafts`),
    ),
  );
}
