// @ts-check
// What this browser knows of drafts: copies of edits that the service has not confirmed, and the drafts that were made here.

/** @typedef {{plan: any, revision: number, writer: string, origin: any, at: string}} Copy */

const COPY = "rths.draft.";
const MADE_HERE = "rths.drafts";
const MOST = 50; // drafts made here that are remembered

/** @param {string} id @param {Copy} copy */
export function hold(id, copy) {
  try {
    localStorage.setItem(COPY + id, JSON.stringify(copy));
  } catch {
    // the storage of the browser is full: the service still holds what it confirmed
  }
}

/** @param {string} id @returns {Copy | null} */
export function heldHere(id) {
  const text = localStorage.getItem(COPY + id);
  return text ? JSON.parse(text) : null;
}

/** @param {string} id */
export const release = (id) => localStorage.removeItem(COPY + id);

/** Ids of the drafts with a copy in this browser. */
export const heldIds = () =>
  Object.keys(localStorage)
    .filter((key) => key.startsWith(COPY))
    .map((key) => key.slice(COPY.length));

/** Ids of the drafts that were made in this browser, oldest first. @returns {string[]} */
export const madeHere = () => JSON.parse(localStorage.getItem(MADE_HERE) ?? "[]");

/** @param {string} id */
export function remember(id) {
  const known = madeHere();
  if (!known.includes(id)) localStorage.setItem(MADE_HERE, JSON.stringify([...known, id].slice(-MOST)));
}
