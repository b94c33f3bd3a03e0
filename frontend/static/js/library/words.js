// @ts-check
import { el } from "../dom.js";
import { when } from "../format.js";

/** @typedef {{title: string, unit: string, value?: string | null, problem: string, fix?: string | null}} DraftProblem */

const SHOWN = 3; // problems of a draft in a list

/** Local time of a save, with the date where it is not today's. @param {string} iso */
export function savedAt(iso) {
  const text = when(iso);
  return text.slice(0, 10) === when(new Date().toISOString()).slice(0, 10) ? text.slice(11) : text;
}

/** Local date and time to the minute. @param {string} iso */
export const minute = (iso) => when(iso).slice(0, 16);

/** The address of the form filled from an origin. @param {import("./draft.js").Origin} origin */
export function addressOf({ kind, id, version }) {
  if (kind === "version") return `/new?library=${encodeURIComponent(id)}${version ? `&version=${version}` : ""}`;
  return `/new?${kind === "run" ? "from" : "template"}=${encodeURIComponent(id)}`;
}

/** A problem of a draft as a sentence. @param {DraftProblem} problem */
export function problemWords({ title, unit, value, problem, fix }) {
  const given = value == null ? "" : ` = ${value}${unit && Number.isFinite(Number(value)) ? ` ${unit}` : ""}`;
  return `${title}${title && given}${title && ": "}${problem}${fix ? ` (${fix})` : ""}`;
}

/** What is not valid in a draft: the first problems in words. @param {DraftProblem[]} problems @returns {HTMLElement} */
export function problemsOf(problems) {
  if (!problems.length) return el("span", { class: "valid" }, "Ready to queue");
  const more = problems.length - SHOWN;
  return el(
    "ul",
    { class: "wrong" },
    ...problems.slice(0, SHOWN).map((one) => el("li", {}, problemWords(one))),
    more > 0 && el("li", {}, `and ${more} more`),
  );
}

/** A table with headings in a region that scrolls. A heading that starts with `#` is of a column of numbers. @param {string} label @param {string[]} heads @param {HTMLElement[]} rows */
export function tableOf(label, heads, rows) {
  const head = heads.map((text) => {
    const number = text.startsWith("#");
    return el("th", { scope: "col", class: number && "number" }, text.replace("#", "") || el("span", { class: "unseen" }, "Actions"));
  });
  return el(
    "div",
    { class: "scroll", tabindex: "0", role: "region", "aria-label": label },
    el("table", { class: "library" }, el("thead", {}, el("tr", {}, ...head)), el("tbody", {}, ...rows)),
  );
}

/** A small button of a row. @param {string} verb @param {string} object @param {() => void} click @param {string | false} [needs] the role */
export function rowButton(verb, object, click, needs = false) {
  return el("button", { type: "button", class: "quiet small", "data-needs": needs, "aria-label": `${verb} ${object}`, on: { click } }, verb);
}
