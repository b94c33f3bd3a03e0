// @ts-check
import { el } from "../dom.js";
import { fixed } from "../format.js";

/** @type {[string, string, string, number][]} key, name, unit, decimals */
const MEASURES = [
  ["mte_mm", "MTE", "mm", 2],
  ["rms_percent", "RMS", "%", 2],
  ["mti_mm2", "MTI", "mm²", 1],
  ["mee_kNm", "MEE", "kNm", 2],
  ["peak_stroke_mm", "Peak stroke", "mm", 1],
  ["peak_force_kN", "Peak force", "kN", 1],
];

const LONG = {
  MTE: "maximum tracking error",
  RMS: "root mean square of the tracking error, relative to the command's",
  MTI: "extreme tracking indicator",
  MEE: "extreme energy error",
};

/** What says nothing in a kind of test: without a structure there is no energy to be fed into it. @type {Record<string, string[]>} */
const SILENT = { specimen: ["mti_mm2", "mee_kNm", "energy_error_percent"], actuator: ["mee_kNm", "energy_error_percent"] };

/**
 * The measures of each station that say something in the kind of test; beneath each the paper's, when the plan is one of its simulations.
 * `paper` holds a pair of values a measure, or null where the paper's test was unstable.
 * @param {any[]} stations @param {Record<string, any> | null} paper @param {string} test
 */
export function metricsTable(stations, paper, test) {
  const measures = MEASURES.filter(([key]) => !SILENT[test]?.includes(key));
  const head = measures.map(([, name, unit]) => el("th", { class: "number", scope: "col", title: LONG[/** @type {keyof typeof LONG} */ (name)] }, `${name}, ${unit}`));
  const rows = stations.flatMap((station, i) => [
    row("measured", station.name, measures.map(([key, , , decimals]) => fixed(station[key], decimals))),
    paper && row("paper", `Table IV, simulation ${paper.simulation}`, measures.map(([key, , , decimals]) => ofPaper(paper, key, i, decimals))),
  ]);
  return table("Measures of each station", [el("th", { scope: "col" }, "Station"), ...head], rows);
}

/** Largest floor displacements, where nothing else is measured. @param {number[]} peaks */
export function floorsTable(peaks) {
  const head = [el("th", { scope: "col" }, "Floor"), el("th", { class: "number", scope: "col" }, "Peak displacement, mm")];
  return table("Peak displacement of each floor", head, peaks.map((peak, i) => row("measured", `Floor ${i + 1}`, [fixed(peak, 1)])));
}

/** @param {string} label @param {HTMLElement[]} head @param {any[]} rows */
function table(label, head, rows) {
  return el(
    "div",
    { class: "scroll", tabindex: "0", role: "region", "aria-label": label },
    el("table", {}, el("thead", {}, el("tr", {}, ...head)), el("tbody", {}, ...rows)),
  );
}

/** @param {Record<string, any>} paper @param {string} key @param {number} station @param {number} decimals */
function ofPaper(paper, key, station, decimals) {
  if (!(key in paper)) return "";
  return paper[key] === null ? "unstable" : fixed(paper[key][station], Math.min(decimals, 1));
}

/** @param {string} kind @param {string} name @param {string[]} values */
function row(kind, name, values) {
  return el("tr", { class: kind }, el("th", { scope: "row" }, name), ...values.map((value) => el("td", { class: "number" }, value)));
}
