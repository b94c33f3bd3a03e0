// @ts-check
import { el } from "../dom.js";
import { fixed, significant } from "../format.js";
import { margin } from "./margin.js";

const BEYOND = 1.12; // of the limit: the end of the bar
const ENDS = [-BEYOND, BEYOND];

/**
 * One quantity against its limit: the present value, the range that it has covered, and both limits as lines. Without a limit the
 * bar ends at `scale`, which the caller sets. The colour of the range is the margin of the peak, and words say the same.
 */
export class Gauge {
  /** @param {string} label @param {string} unit @param {number | null} limit in the unit shown */
  constructor(label, unit, limit) {
    this.limit = limit;
    this.scale = (limit ?? 1) * (limit ? 1 : BEYOND);
    this.now = el("output", { class: "gauge-now", "aria-live": "off" }, "–");
    this.range = el("span", { class: "gauge-range" });
    this.needle = el("span", { class: "gauge-needle" });
    this.peak = el("span", { class: "gauge-peak" }, "peak –");
    this.share = el("span", { class: "gauge-share" });
    this.bound = limit === null ? null : el("span", { class: "gauge-limit" }, `limit ${significant(limit, 4)}`);
    this.element = el(
      "span",
      { class: limit === null ? "gauge free" : "gauge", "data-margin": "none" },
      el("span", { class: "gauge-label" }, label),
      el("span", { class: "gauge-value" }, this.now, el("span", { class: "gauge-unit" }, unit)),
      el("span", { class: "gauge-bar" }, el("span", { class: "gauge-zero" }), this.range, this.needle),
      el("span", { class: "gauge-foot" }, this.peak, this.bound, this.share),
    );
  }

  /**
   * Show the present value and the range so far; `beyond` is the value that tripped the test. Returns the margin of the peak.
   * @param {number} value @param {number} lowest @param {number} highest @param {number | null} [beyond] @param {boolean} [numbers] whether the numbers change too
   */
  show(value, lowest, highest, beyond = null, numbers = true) {
    const covered = lowest <= highest;
    const peak = beyond !== null ? Math.abs(beyond) : covered ? Math.max(-lowest, highest) : NaN;
    const found = margin(peak, this.limit);
    const [low, high] = [this.#place(Math.min(lowest, beyond ?? 0, 0)), this.#place(Math.max(highest, beyond ?? 0, 0))];
    this.range.style.transform = `translateX(${(low * 100).toFixed(2)}%) scaleX(${(high - low).toFixed(4)})`;
    this.needle.style.transform = `translateX(${(this.#place(value) * 100).toFixed(2)}%)`;
    if (!numbers) return found;
    this.now.textContent = fixed(value, decimals(this.limit ?? this.scale));
    this.needle.hidden = !Number.isFinite(value);
    this.peak.textContent = `peak ${fixed(peak, decimals(this.limit ?? this.scale))}`;
    this.element.dataset.margin = found.level;
    if (this.limit !== null) this.share.textContent = [percent(found.share), found.words].filter(Boolean).join(", ");
    return found;
  }

  /** The place of a value along the bar, from 0 to 1. @param {number} value */
  #place(value) {
    const at = (value / this.scale - ENDS[0]) / (ENDS[1] - ENDS[0]);
    return Math.min(1, Math.max(0, Number.isFinite(at) ? at : value > 0 ? 1 : 0.5));
  }
}

/** @param {number} share */
const percent = (share) => (Number.isFinite(share) ? `${(100 * share).toFixed(0)} %` : share === Infinity ? "no number" : "");

/** Decimals that give a reading of about three digits near the limit. @param {number} limit */
const decimals = (limit) => (limit >= 100 ? 1 : limit >= 10 ? 2 : 3);
