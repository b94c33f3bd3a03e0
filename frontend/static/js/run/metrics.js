// @ts-check
import { el } from "../dom.js";
import { fixed } from "../format.js";
import { BEYOND, PAPERS, telling } from "./measures.js";

/** @typedef {import("./measures.js").Measure} Measure */

/**
 * Tables of the measures of each station that say something in the kind of test: the paper's, and beneath each station the values
 * published, when the plan is one of its simulations; then the others. `paper` holds a pair of values a measure, or null where the
 * paper's test was unstable.
 * @param {any[]} stations @param {Record<string, any> | null} paper @param {string} test
 */
export function metricsTables(stations, paper, test) {
  return [
    stationsTable("Measures of each station", telling(PAPERS, test), stations, paper),
    stationsTable("Further measures of each station", telling(BEYOND, test), stations, null),
  ];
}

/** Largest floor displacements, where nothing else is measured. @param {number[]} peaks */
export function floorsTable(peaks) {
  const head = [el("th", { scope: "col" }, "Floor"), el("th", { class: "number", scope: "col" }, "Peak displacement, mm")];
  return table("Peak displacement of each floor", head, peaks.map((peak, i) => row("", `Floor ${i + 1}`, [fixed(peak, 1)])));
}

/** @param {string} name @param {Measure[]} measures @param {any[]} stations @param {Record<string, any> | null} paper */
function stationsTable(name, measures, stations, paper) {
  const head = measures.map(({ label, unit, long }) => el("th", { class: "number", scope: "col", title: long }, unit ? `${label}, ${unit}` : label));
  const rows = stations.flatMap((station, i) => [
    row(paper ? "measured" : "", station.name, measures.map(({ key, decimals }) => fixed(station[key], decimals))),
    ...(paper ? [row("paper", `Table IV, simulation ${paper.simulation}`, measures.map(({ key, decimals }) => ofPaper(paper, key, i, decimals)))] : []),
  ]);
  return table(name, [el("th", { scope: "col" }, "Station"), ...head], rows);
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
