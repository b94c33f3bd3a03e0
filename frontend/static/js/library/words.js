// @ts-check
import { when } from "../format.js";

/** Local time of a save, with the date where it is not today's. @param {string} iso */
export function savedAt(iso) {
  const text = when(iso);
  return text.slice(0, 10) === when(new Date().toISOString()).slice(0, 10) ? text.slice(11) : text;
}

/** The address of the form filled from an origin. @param {import("./draft.js").Origin} origin */
export function addressOf({ kind, id, version }) {
  if (kind === "version") return `/new?library=${encodeURIComponent(id)}${version ? `&version=${version}` : ""}`;
  return `/new?${kind === "run" ? "from" : "template"}=${encodeURIComponent(id)}`;
}
