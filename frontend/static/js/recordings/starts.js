// @ts-check
import { el } from "../dom.js";

/**
 * What a mapping can start from: a mapping saved for the layout of the file, the proposal, or the mapping of an earlier import.
 * @typedef {{label: string, mapping: any, why: (column: string) => string, doubtful: (column: string) => boolean}} Start
 */

const never = () => false;

/** The starts that fit a file, by their group; the first of all is the one to begin with. @param {any} sent the service's description of the file @returns {Map<string, Start[]>} */
export function startsOf(sent) {
  const proposal = {
    label: "proposed from names and signals",
    mapping: sent.guess ?? { channels: [] },
    why: (/** @type {string} */ name) => sent.reasons[name] ?? sent.left_out[name] ?? "",
    doubtful: (/** @type {string} */ name) => sent.doubtful.includes(name),
  };
  const saved = sent.saved.map((/** @type {any} */ one) => ({
    label: `${one.name}, saved ${one.saved_at.slice(0, 10)}`,
    mapping: { ...one.mapping, title: "" },
    why: () => `from the saved mapping ${one.name}`,
    doubtful: never,
  }));
  const earlier = sent.mappings.map((/** @type {any} */ one) => ({
    label: `mapping of ${one.name}, imported ${one.imported_at.slice(0, 10)}`,
    mapping: { ...one.mapping, title: "" },
    why: () => `from the mapping of ${one.name}`,
    doubtful: never,
  }));
  return new Map([
    ["saved for this layout", saved],
    ["proposal", [proposal]],
    ["earlier imports", earlier],
  ]);
}

/** A list to choose a start from. @param {Map<string, Start[]>} starts @param {(start: Start) => void} chosen @returns {any} */
export function chooser(starts, chosen) {
  const all = [...starts.values()].flat();
  const options = (/** @type {Start[]} */ some) => some.map((start) => el("option", { value: all.indexOf(start) }, start.label));
  const groups = [...starts].filter(([, some]) => some.length).map(([label, some]) => el("optgroup", { label }, ...options(some)));
  const select = el("select", {}, ...groups);
  select.addEventListener("change", () => chosen(all[Number(select.value)]));
  return select;
}

/** @param {any} sent */
export function fitting({ saved, mappings }) {
  const earlier = mappings.length ? `${mappings.length} earlier ${mappings.length === 1 ? "mapping fits" : "mappings fit"} this file` : "no earlier mapping fits this file";
  return saved.length ? `${saved.length} saved for files of this layout; ${earlier}` : earlier;
}
