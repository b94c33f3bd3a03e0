// @ts-check
import { el } from "../dom.js";
import { digits } from "./results.js";

/** A time in seconds, minutes or hours. @param {number} seconds */
export function lasting(seconds) {
  if (seconds < 120) return `${digits(seconds)} s`;
  return seconds < 7200 ? `${digits(seconds / 60)} min` : `${digits(seconds / 3600)} h`;
}

/** What the service says of a sweep before it is queued. @param {any} found @returns {HTMLElement[]} */
export function previewed(found) {
  const { stability, duration } = found;
  const examined = found.all_examined ? "all points" : `a random sample of ${found.examined} points`;
  const unstable = stability.unstable ? `${stability.unstable} of ${stability.predicted} examined points are predicted unstable.` : `All ${stability.predicted} examined points are predicted stable about rest.`;
  return [
    el("p", {}, el("span", { class: "large" }, String(found.points)), found.points === 1 ? " point" : " points"),
    el("p", {}, duration.predicted_s === null ? "Time: not known yet. " : `Time: about ${lasting(duration.predicted_s)} in ${duration.processes} ${duration.processes === 1 ? "process" : "processes"}. `, el("span", { class: "muted" }, duration.basis)),
    el("p", { class: stability.unstable ? "note" : "" }, stability.predicted ? unstable : "Stability is not predicted for this kind of test."),
    ...refusals(stability.first_unstable),
    el("p", { class: found.invalid ? "note bad" : "" }, found.invalid ? `${found.invalid} of ${found.examined} examined points are not valid and give no result.` : `Checked: ${examined}, all valid.`),
    ...refusals(found.first_invalid),
    ...found.notes.map((/** @type {string} */ note) => el("p", { class: "note" }, note)),
  ];
}

/** @param {any[]} some */
function refusals(some) {
  if (!some.length) return [];
  return [el("ul", {}, ...some.map(({ point, reason }) => el("li", {}, `Point ${point}: ${reason}`)))];
}
