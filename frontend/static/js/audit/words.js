// @ts-check
// What an entry of the audit log says in one line, and all that it holds.

/** @typedef {{number: number, at: string, who: string, role: string, signed_in: string, action: string, about: string, run: {id: string, number: number, name: string} | null, details: Record<string, any>, previous: string, hash: string}} Entry */

const LONGEST = 160;
const MOST = 5; // rows that were added, in the line
const UNTOLD = new Set(["by", "submitted_by", "bytes", "sha256", "fields"]);

/** One line about an entry: the sentence of an event, or what the request gave. @param {Entry} entry */
export function line({ details }) {
  if (details.sentence) return String(details.sentence);
  const given = Object.entries(details.given ?? {}).filter(([name]) => !UNTOLD.has(name));
  const made = (details.made ?? []).map((/** @type {any} */ one) => `${one.is.split(":")[0].replaceAll("_", " ")} ${one.number ?? ""}`.trim());
  const parts = [
    made.length && `added: ${made.slice(0, MOST).join(", ")}${details.made_in_all > MOST ? ` and ${details.made_in_all - MOST} more` : ""}`,
    ...given.map(([name, value]) => `${name}: ${text(value)}`),
  ];
  const said = parts.filter(Boolean).join(", ") || (details.method ? `${details.method} ${details.path}` : "No details");
  return said.length > LONGEST ? `${said.slice(0, LONGEST)}…` : said;
}

/** Names and values of everything that an entry holds. @param {Entry} entry @returns {[string, string][]} */
export function facts({ details, previous, hash, role, signed_in }) {
  /** @type {[string, string][]} */
  const found = Object.entries(details).map(([name, value]) => [name.replaceAll("_", " "), text(value)]);
  if (role) found.push(["role", role]);
  if (signed_in) found.push(["signed in", signed_in]);
  return [...found, ["hash", hash], ["hash before", previous]];
}

/** @param {any} value */
const text = (value) => (typeof value === "string" ? value : JSON.stringify(value));
