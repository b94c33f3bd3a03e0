// @ts-check
// Copies of drafts in this browser: kept while the service has not confirmed the last edit.

/** @typedef {{plan: any, revision: number, writer: string, origin: any, at: string}} Copy */

const PREFIX = "rths.draft.";

/** @param {string} id @param {Copy} copy */
export function hold(id, copy) {
  try {
    localStorage.setItem(PREFIX + id, JSON.stringify(copy));
  } catch {
    // the storage of the browser is full or switched off; the service holds what it confirmed
  }
}

/** @param {string} id @returns {Copy | null} */
export function heldHere(id) {
  const text = localStorage.getItem(PREFIX + id);
  return text ? JSON.parse(text) : null;
}

/** @param {string} id */
export const release = (id) => localStorage.removeItem(PREFIX + id);

/** Ids of all drafts with a copy in this browser. */
export const heldIds = () => Object.keys(localStorage).filter((key) => key.startsWith(PREFIX)).map((key) => key.slice(PREFIX.length));
