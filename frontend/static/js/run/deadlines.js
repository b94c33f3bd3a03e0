// @ts-check
import { el, renew } from "../dom.js";
import { number, significant } from "../format.js";
import { margin } from "./margin.js";

/**
 * The deadlines of a test in real time: the timing of a run (`timing` of `/api/v1/runs/{id}`), or of a running test so far, which
 * has no percentiles, verdicts and rights.
 * @typedef {{rate_hz: number, period_us: number, steps: number, missed: number, late: number,
 *   worst: {step: number, time_s: number, delay_us: number, length_us: number, share: number} | null,
 *   histogram: {edges_us: number[], delay: number[], length: number[]},
 *   delay_us?: Record<string, number | null>, length_us?: Record<string, number | null>,
 *   verdicts?: {rate_hz: number, missed: number, met: boolean}[],
 *   granted?: {core: number | null, priority: number | null, memory_locked: boolean, refused: string[]}}} Timing
 */

const PERCENTILES = { p50: "Median", p99: "99 %", p999: "99.9 %", max: "Largest" };
const LEAST = 0.004; // of the width of a bar, for a bucket that is not empty

/** The panel of the deadlines of a test in real time. Colour is the margin of the worst step to its deadline. */
export class Deadlines {
  /** @param {HTMLElement} host */
  constructor(host) {
    this.tiles = el("dl", { class: "deadlines-tiles" });
    this.said = el("div", { class: "deadlines-said" });
    this.spread = el("div", { class: "scroll" });
    this.waiting = el("p", { class: "note" }, "The deadlines of the controller steps appear here when the test starts.");
    renew(
      host,
      el("h2", {}, "Deadlines"),
      this.waiting,
      this.tiles,
      this.said,
      (this.fold = el("details", {}, el("summary", {}, "How late steps began (delay) and how long they took (length)"), this.spread)),
    );
    this.fold.hidden = true;
  }

  /** @param {Timing} timing */
  show(timing) {
    this.waiting.hidden = true;
    this.fold.hidden = false;
    renew(this.tiles, ...tiles(timing));
    renew(this.said, ...(timing.granted?.refused ?? []).map((one) => el("p", { class: "note" }, one)));
    renew(this.spread, ...(timing.delay_us ? [percentiles(timing)] : []), histogram(timing));
  }
}

/** @param {Timing} timing @returns {HTMLElement[]} */
function tiles({ rate_hz, period_us, steps, missed, late, worst, verdicts, granted }) {
  const found = margin(worst?.share ?? NaN, 1);
  const share = worst && `${significant(100 * worst.share)} % of ${significant(period_us)} µs`;
  const words = found.level === "over" ? ", deadline missed" : found.level === "near" ? ", near the deadline" : "";
  return [
    tile("Controller rate", `${significant(rate_hz, 4)} Hz`),
    tile("Missed deadlines", `${missed} of ${steps} steps`, missed ? "over" : "none"),
    tile("Begun late", `${late} steps`, "none", "Steps that began more than a tenth of a period after their due time"),
    tile("Worst step", share ? `${share}${words}` : "–", found.level, worst ? `Step ${worst.step}: began ${number(worst.delay_us, 3)} µs late, took ${number(worst.length_us, 3)} µs` : ""),
    ...(worst ? [tile("Time of the worst step", `${worst.time_s.toFixed(2)} s`)] : []),
    ...(verdicts ?? []).map((one) => tile(`Would have met ${one.rate_hz} Hz`, one.met ? "yes" : `no, ${one.missed} missed`, one.met ? "none" : "over")),
    ...(granted ? [tile("Priority", granted.priority === null ? "ordinary" : `real time, ${granted.priority}`), tile("Core", granted.core === null ? "any" : String(granted.core))] : []),
  ];
}

/** @param {string} label @param {string} value @param {string} [level] @param {string} [title] */
const tile = (label, value, level = "none", title = "") =>
  el("div", { "data-margin": level, ...(title && { title }) }, el("dt", {}, label), el("dd", {}, value));

/** @param {Timing} timing */
function percentiles({ delay_us, length_us }) {
  const row = (/** @type {string} */ label, /** @type {Record<string, number | null> | undefined} */ values) =>
    el("tr", {}, el("th", { scope: "row" }, label), ...Object.keys(PERCENTILES).map((key) => el("td", { class: "number" }, number(values?.[key], 3))));
  return table("Percentiles, µs", ["Quantity", ...Object.values(PERCENTILES)], [row("Delay", delay_us), row("Length", length_us)]);
}

/** The filled part of the histogram, with the width of bars on a logarithmic scale. @param {Timing} timing */
function histogram({ histogram: { edges_us, delay, length } }) {
  const filled = delay.map((count, place) => (count || length[place] ? place : -1)).filter((place) => place >= 0);
  const largest = Math.log1p(Math.max(1, ...delay, ...length));
  const cell = (/** @type {number} */ count) => {
    const bar = el("span", { class: "deadlines-bar" });
    bar.style.width = `${100 * (count ? Math.max(LEAST, Math.log1p(count) / largest) : 0)}%`;
    return el("td", { class: "number" }, String(count), bar);
  };
  const rows = [];
  for (let place = filled[0] ?? 0; place <= (filled.at(-1) ?? -1); place += 1) {
    rows.push(el("tr", {}, el("th", { scope: "row" }, range(edges_us, place)), cell(delay[place]), cell(length[place])));
  }
  return table("Number of steps; bars are logarithmic", ["Time, µs", "Delay", "Length"], rows);
}

/** @param {number[]} edges @param {number} place */
const range = (edges, place) =>
  place === 0 ? `below ${edges[0]}` : place === edges.length ? `from ${edges.at(-1)}` : `${edges[place - 1]} to ${edges[place]}`;

/** @param {string} caption @param {string[]} heads @param {HTMLElement[]} rows */
const table = (caption, heads, rows) =>
  el(
    "table",
    {},
    el("caption", {}, caption),
    el("thead", {}, el("tr", {}, ...heads.map((head, i) => el("th", { scope: "col", class: i ? "number" : "" }, head)))),
    el("tbody", {}, ...rows),
  );
