// @ts-check
import { el } from "../dom.js";

/** @typedef {{ahead: string, behind: string, lag_s: number, low_s: number, high_s: number, factor: number, correlation: number, one_clock: boolean, sentence: string}} Lag */

/**
 * Lags between channels that measure the same thing. A lag between two clocks is offered with a button; a lag within one clock
 * is of the test itself and is only reported.
 * @param {Lag[]} lags @param {(lag: Lag) => void} apply @returns {HTMLElement}
 */
export function lagsOf(lags, apply) {
  if (!lags.length) return el("div");
  const offered = lags.filter(({ one_clock, low_s, high_s }) => !one_clock && (low_s > 0 || high_s < 0));
  const button = (/** @type {Lag} */ lag) => el("button", { type: "button", class: "quiet small", on: { click: () => apply(lag) } }, `Apply lag to ${lag.behind}`);
  const item = (/** @type {Lag} */ lag) => el("li", {}, el("span", {}, lag.sentence), offered.includes(lag) && button(lag));
  const hint = offered.length > 0 && el("p", { class: "muted" }, "A lag that you apply is subtracted from the times of the channel. You can change it in the column Lag.");
  return el("section", { class: "lags", "aria-label": "Lags between channels" }, el("h4", {}, "Lags between channels of one motion"), el("ul", {}, ...lags.map(item)), hint);
}
