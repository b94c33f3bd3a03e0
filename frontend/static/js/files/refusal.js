// @ts-check
import { ApiError, sentence } from "../api.js";
import { el } from "../dom.js";

/** @typedef {import("../api.js").Problem} Problem */

/** Why a file was refused: what, where, the value and how to mend it, with the named line among its neighbours. @param {unknown} error @returns {HTMLElement} */
export function refusalOf(error) {
  if (!(error instanceof ApiError)) throw error;
  if (!error.errors.length) return el("p", {}, error.message);
  return el("ul", { class: "refusals" }, ...error.errors.map(item));
}

/** @param {Problem} problem */
function item(problem) {
  const { where, value, lines = [] } = problem;
  const said = sentence(problem).slice(where ? where.length : 0);
  const given = value && !lines.length ? el("code", { class: "given" }, value) : null;
  const named = Number(where.match(/\bline (\d+)\b/)?.[1]);
  return el("li", {}, el("p", {}, where && el("strong", {}, where), said, given && " ", given), lines.length > 0 && surroundings(lines, named, value ?? ""));
}

/** @param {{number: number, text: string}[]} lines @param {number} named @param {string} value */
function surroundings(lines, named, value) {
  const label = `Lines ${lines[0].number} to ${lines[lines.length - 1].number} of the file`;
  const rows = lines.map(({ number, text }) =>
    el("span", { class: number === named ? "line named" : "line" }, el("span", { class: "at" }, String(number)), ...(number === named ? marked(text, value) : [text]), "\n"),
  );
  return el("pre", { class: "lines", tabindex: "0", role: "region", "aria-label": label }, ...rows);
}

/** The text with the refused value marked. @param {string} text @param {string} value */
function marked(text, value) {
  const at = value && value !== text.trim() ? text.indexOf(value) : -1;
  if (at < 0) return [text];
  return [text.slice(0, at), el("mark", {}, value), text.slice(at + value.length)];
}
