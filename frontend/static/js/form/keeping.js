// @ts-check
import { api, explain } from "../api.js";
import { byId, el } from "../dom.js";
import { Draft } from "../library/draft.js";
import { offerDrafts } from "../library/own_drafts.js";
import { saveToLibrary } from "../library/save_dialog.js";
import { addressOf } from "../library/words.js";

/** @typedef {import("../library/draft.js").Origin} Origin */

/** What the address of the page asks for: a draft, or what the form is to be filled from. @returns {{draft: string | null, origin: Origin | null}} */
export function asked() {
  const query = new URLSearchParams(location.search);
  const [library, run, template] = ["library", "from", "template"].map((name) => query.get(name));
  /** @type {Origin | null} */
  let origin = null;
  if (library) origin = { kind: "version", id: library, version: Number(query.get("version")) || null };
  else if (run) origin = { kind: "run", id: run };
  else if (template) origin = { kind: "template", id: template };
  return { draft: query.get("draft"), origin };
}

/** The plan of an origin, and the origin with its version. @param {Origin} origin @returns {Promise<{plan: any, origin: Origin}>} */
export async function planOf(origin) {
  const id = encodeURIComponent(origin.id);
  if (origin.kind === "template") return { plan: (await api.get(`/templates/${id}`)).plan, origin };
  if (origin.kind === "run") return { plan: (await api.get(`/runs/${id}`)).plan, origin };
  const version = origin.version ?? (await api.get(`/library/plans/${id}`)).versions;
  return { plan: (await api.get(`/library/plans/${id}/versions/${version}`)).plan, origin: { ...origin, version } };
}

/** The draft of the form, and its way into the library. @param {import("../library/draft.js").Form & {saved: () => void}} form `saved` is called when the library holds the plan */
export function keeping(form) {
  const draft = new Draft(byId("draft"), form);
  const said = byId("draft");

  /** The name of the plan in the library that the form was opened from. */
  const library = async () => {
    const { origin } = draft;
    if (origin?.kind !== "version" || !origin.version) return null;
    const { name } = await api.get(`/library/plans/${origin.id}`);
    return { id: origin.id, name, version: origin.version };
  };

  const keep = async () => {
    await draft.flush();
    saveToLibrary({ plan: form.read(), by: form.owner(), library: await library(), draft: draft.revision ? draft.id : null }, (saved) => {
      /** @type {Origin} */
      const origin = { kind: "version", id: saved.id, version: saved.version.number };
      draft.edited = false;
      draft.begin(origin);
      form.saved();
      history.replaceState(null, "", addressOf(origin));
      const link = el("a", { href: `/plans/${saved.id}` }, saved.name);
      const words = saved.created ? `Saved as version ${saved.version.number} of ` : `Equal to version ${saved.version.number}: nothing new to save in `;
      said.replaceChildren(el("span", {}, words, link));
    });
  };
  byId("keep").addEventListener("click", () => keep().catch((error) => said.replaceChildren(el("span", { class: "error", role: "alert" }, explain(error)))));

  return {
    draft,
    /** Offer what this person left unfinished. */
    offer: () => offerDrafts(byId("drafts"), form.owner()),
    /** The version in the library that a run of this form is queued from. */
    source: () => (draft.origin?.kind === "version" && draft.origin.version ? { id: draft.origin.id, version: draft.origin.version } : null),
  };
}
