// @ts-check
import { el } from "../dom.js";
import { fixed } from "../format.js";
import { heading, meaning, of } from "./measures.js";

/** @typedef {import("./measures.js").Measure} Measure */

/**
 * The tables of measures: for each station, with the published values below each station if the plan is a simulation of the paper;
 * for a test without stations, for each floor. `paper` holds a pair of values for each measure, or null if the paper's simulation
 * was unstable.
 * @param {any} run @param {Record<string, any> | null} paper @param {Measure[]} measures
 */
export function metricsTables(run, paper, measures) {
  if (!run.stations.length) return [floorsTable(run, of(measures, "floor", run.test))];
  const own = of(measures, "station", run.test);
  return [
    stationsTable("Measures of each station", own.filter(({ further }) => !further), run.stations, paper),
    stationsTable("Further measures of each station", own.filter(({ further }) => further), run.stations, null),
  ];
}

/** The number of floors for which a run has measures. @param {any} run @param {Measure[]} measures */
export const floorCount = (run, measures) => Math.max(0, ...measures.filter(({ scope }) => scope === "floor").map(({ key }) => run[key]?.length ?? 0));

/** @param {any} run @param {Measure[]} measures */
function floorsTable(run, measures) {
  const rows = Array.from({ length: floorCount(run, measures) }, (_, i) =>
    row("", `Floor ${i + 1}`, measures.map(({ key, decimals }) => fixed(run[key]?.[i], decimals))),
  );
  return table("Measures of each floor", heads("Floor", measures), rows);
}

/** @param {string} name @param {Measure[]} measures @param {any[]} stations @param {Record<string, any> | null} paper */
function stationsTable(name, measures, stations, paper) {
  const rows = stations.flatMap((station, i) => [
    row(paper ? "measured" : "", station.name, measures.map(({ key, decimals }) => fixed(station[key], decimals))),
    ...(paper ? [row("paper", `Table IV, simulation ${paper.simulation}`, measures.map(({ key, decimals }) => ofPaper(paper, key, i, decimals)))] : []),
  ]);
  return table(name, heads("Station", measures), rows);
}

/** @param {string} first @param {Measure[]} measures */
const heads = (first, measures) => [
  el("th", { scope: "col" }, first),
  ...measures.map((one) => el("th", { class: "number", scope: "col", title: meaning(one) }, heading(one))),
];

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
