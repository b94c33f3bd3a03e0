// @ts-check
import { el } from "../dom.js";
import { number } from "../format.js";
import { longest } from "./peaks.js";
import { goTo } from "./station_fold.js";

/** The key figures of a valid plan, and its warnings. @param {any} checked @returns {HTMLElement[]} */
export function summaryOf({ digest, summary, warnings, plan }) {
  const periods = summary.periods_s.slice(0, 2).map((/** @type {number} */ period, /** @type {number} */ i) => [`T${i + 1}`, `${number(period)} s`]);
  const rows = [
    ...periods,
    ["Steps", summary.steps],
    ["Duration", plan?.test === "client" ? longest(summary.duration_s) : `${number(summary.duration_s)} s`],
    ...(summary.pga == null ? [] : [["Scale factor", number(summary.scale_factor)], ["Scaled PGA", `${number(summary.pga / 9.80665, 3)} g`]]),
    ["Digest", digest],
  ];
  const facts = rows
    .filter(([, value]) => value != null)
    .flatMap(([term, value]) => [el("dt", {}, term), el("dd", { title: value }, String(value))]);
  const told = warnings.map((/** @type {string} */ warning) => el("li", {}, warning));
  return [el("dl", { class: "facts" }, ...facts), ...(told.length ? [el("ul", { class: "warnings" }, ...told)] : [])];
}

/** A list of problems, each with a link to its field. @param {any[]} problems @param {(where: string) => HTMLElement | null} control */
export function problemList(problems, control) {
  const items = problems.map(({ where, problem, fix }) => {
    const text = [problem, fix && `(${fix})`].filter(Boolean).join(" ");
    const target = control(where);
    if (!target) return el("li", {}, [where, text].filter(Boolean).join(": "));
    const go = (/** @type {Event} */ event) => {
      event.preventDefault();
      goTo(target);
    };
    return el("li", {}, el("a", { href: `#${target.id}`, on: { click: go } }, labelOf(target, where)), `: ${text}`);
  });
  return el("ul", { class: "problems" }, ...items);
}

/** @param {HTMLElement} control @param {string} where */
function labelOf(control, where) {
  const station = /^stations\.(\d+)\./.exec(where);
  const label = document.querySelector(`label[for="${CSS.escape(control.id)}"]`)?.textContent ?? where;
  return station ? `Station ${Number(station[1]) + 1}, ${label}` : label;
}
