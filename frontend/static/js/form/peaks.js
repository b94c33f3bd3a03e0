// @ts-check
import { el } from "../dom.js";
import { fixed, number, significant } from "../format.js";
import { margin } from "../run/margin.js";

/** @typedef {import("../run/margin.js").Margin} Margin */

/** As the gauges of the live page name them. @type {Record<string, string>} */
const NAMES = { displacement: "Command stroke", velocity: "Command velocity", force: "Force", oscillation: "Half waves" };
/** As capacities name them. @type {Record<string, string>} */
const CAPACITIES = { displacement: "stroke", velocity: "velocity", force: "force" };
/** @type {Record<string, string>} */
const BOUNDED = { actuator: "Actuator", rig: "Rig" };
const FULL = 1.25; // share of the bound at the right end of a bar
const ROOM = 100 / FULL;

/** Peaks of each station against limits and capacities, floors, delay margins and times. @param {any} found preflight @returns {HTMLElement[]} */
export function peaksOf(found) {
  const stations = new Map(found.uses.map((/** @type {any} */ use) => [use.station, use.name]));
  const margins = new Map((found.stability?.stations ?? []).map((/** @type {any} */ one) => [one.station, one]));
  const groups = [...stations].map(([station, name]) =>
    el(
      "section",
      { class: "peaks-station" },
      el("h3", {}, el("span", { class: "fold-number" }, String(station)), ` ${name}`),
      el("ul", { class: "peaks" }, ...found.uses.filter((/** @type {any} */ use) => use.station === station).map(useOf)),
      margins.has(station) ? el("p", { class: "peaks-margin" }, marginWords(margins.get(station))) : null,
    ),
  );
  const notes = [...found.notes, ...(found.stability?.notes ?? [])].map((/** @type {string} */ note) => el("li", {}, note));
  const beyond = found.trip ? el("p", { class: "peaks-margin" }, `The test would stop at ${fixed(found.trip.time_s, 2)} s. These peaks are those of the whole motion without limits.`) : null;
  return [beyond, ...groups, floorsOf(found.floors), timesOf(found), notes.length ? el("ul", { class: "peaks-notes" }, ...notes) : null].filter((one) => one !== null);
}

/** The margin that a use leaves: a capacity that is reached exactly counts as over. @param {any} use @returns {Margin} */
export function marginOf({ share, against }) {
  if (share === null) return { level: "over", share: Infinity, words: "over limit" };
  return margin(against === "actuator" && share > 1 - 1e-9 ? 1 + 1e-9 : share, 1);
}

/** `249 of 300 mm/s`. @param {any} use */
export const against = ({ peak, bound, factor, shown_label }) => `${peak === null ? "without bound" : significant(peak / factor)} of ${significant(bound / factor, 4)} ${shown_label}`.trim().replace(/ 1$/, "");

/** @param {any} use */
export const percent = ({ share }) => (share === null ? "∞" : `${fixed(100 * share, share < 0.1 ? 1 : 0)} %`);

/** @param {any} use */
function useOf(use) {
  const { level, share } = marginOf(use);
  const bar = el("span", { class: "peak-bar", "aria-hidden": "true" }, el("span", { class: "peak-fill" }), el("span", { class: "peak-bound" }));
  bar.firstElementChild.style.width = `${Math.min(100, ROOM * (Number.isFinite(share) ? share : FULL))}%`;
  bar.lastElementChild.style.left = `${ROOM}%`;
  const label = use.against === "limit" ? NAMES[use.quantity] : `${BOUNDED[use.against]} ${CAPACITIES[use.quantity] ?? NAMES[use.quantity].toLowerCase()}`;
  return el(
    "li",
    { class: `peak ${use.against}`, "data-margin": level, title: `${use.label} against the ${use.against_label}: largest at ${fixed(use.time_s, 2)} s` },
    el("span", { class: "peak-label" }, label),
    el("span", { class: "peak-words" }, against(use)),
    el("span", { class: "peak-share" }, percent(use)),
    bar,
  );
}

/** @param {any} margin of a station */
function marginWords({ steps, seconds }) {
  if (steps === null) return "Remaining delay margin: more than 1000 controller steps";
  return steps === 0 ? "No delay margin: predicted unstable" : `Remaining delay margin: ${number(1e3 * seconds, 3)} ms (${number(steps, 3)} controller steps)`;
}

/** @param {any[]} floors @returns {HTMLElement | null} */
function floorsOf(floors) {
  if (!floors.length) return null;
  const count = Math.max(...floors.map(({ values }) => values.length));
  const heads = floors.map(({ label, shown_label }) => el("th", { scope: "col", class: "number" }, [label, shown_label].filter(Boolean).join(", ")));
  const rows = Array.from({ length: count }, (_, k) =>
    el("tr", {}, el("th", { scope: "row" }, String(k + 1)), ...floors.map(({ values }) => el("td", { class: "number" }, number(values[k], 3)))),
  );
  const table = el("table", {}, el("thead", {}, el("tr", {}, el("th", { scope: "col" }, "Floor"), ...heads)), el("tbody", {}, ...rows));
  return el("div", { class: "scroll", tabindex: "0", role: "region", "aria-label": "Peaks of the floors" }, table);
}

/** The duration of a test that its client ends. @param {number} duration_s */
export const longest = (duration_s) => `at most ${significant(duration_s)} s; the client ends the test`;

/** @param {any} found */
function timesOf({ duration_s, expected_elapsed_s, open_ended }) {
  if (open_ended) return el("dl", { class: "facts" }, el("dt", {}, "Duration of the test"), el("dd", {}, longest(duration_s)));
  const elapsed = expected_elapsed_s === null ? "not known" : expected_elapsed_s < 0.1 ? "less than 0.1 s" : `about ${number(expected_elapsed_s, 2)} s`;
  return el("dl", { class: "facts" }, el("dt", {}, "Duration of the test"), el("dd", {}, `${number(duration_s)} s`), el("dt", {}, "Expected time at its pace"), el("dd", {}, elapsed));
}
