// @ts-check
import { byId, el } from "../dom.js";
import { moved } from "./heads.js";

/** @typedef {import("./cells.js").Column} Column */
const SHOWN = 60; // columns listed at once; a search finds the others

/** Choose columns: search all, add, remove and order them. @param {Column[]} all @param {string[]} keys @param {(keys: string[]) => void} done */
export function chooseColumns(all, keys, done) {
  const dialog = byId("columns-dialog");
  const known = new Map(all.map((one) => [one.key, one]));
  let chosen = [...keys];
  const search = byId("columns-search");
  const label = (/** @type {string} */ key) => known.get(key)?.heading ?? key;

  function show() {
    const words = search.value.toLowerCase().split(/\s+/).filter(Boolean);
    const found = all.filter((one) => words.every((/** @type {string} */ word) => `${one.group} ${one.heading} ${one.key}`.toLowerCase().includes(word)));
    byId("columns-found").replaceChildren(...found.slice(0, SHOWN).map(offered));
    byId("columns-count").textContent =
      found.length > SHOWN ? `${SHOWN} of ${found.length} columns. Search by label, part or path, such as “station 1 stroke”.` : `${found.length} columns`;
    byId("columns-chosen").replaceChildren(...chosen.map(ordered));
  }

  /** @param {Column} one */
  function offered(one) {
    const box = el("input", { type: "checkbox", on: { change: () => {
      chosen = box.checked ? [...chosen, one.key] : chosen.filter((key) => key !== one.key);
      byId("columns-chosen").replaceChildren(...chosen.map(ordered));
    } } });
    box.checked = chosen.includes(one.key);
    return el("li", {}, el("label", {}, box, el("span", {}, one.heading), el("small", { class: "muted" }, one.group === "Plan" ? one.key.slice(5) : one.help || one.group)));
  }

  /** @param {string} key @param {number} place */
  function ordered(key, place) {
    const move = (/** @type {number} */ by, /** @type {string} */ sign, /** @type {string} */ word) =>
      el("button", { type: "button", class: "quiet small", "aria-label": `Move ${label(key)} ${word}`, disabled: chosen[place + by] === undefined, on: { click: () => {
        chosen = moved(chosen, key, by);
        show();
        byId("columns-chosen").children[place + by]?.querySelector(`[aria-label$="${word}"]`)?.focus();
      } } }, sign);
    const remove = el("button", { type: "button", class: "quiet small", "aria-label": `Remove ${label(key)}`, on: { click: () => {
      chosen = chosen.filter((one) => one !== key);
      show();
    } } }, "✕");
    return el("li", {}, el("span", {}, label(key)), move(-1, "↑", "up"), move(1, "↓", "down"), remove);
  }

  search.value = "";
  search.oninput = show;
  byId("columns-form").onsubmit = () => done(chosen);
  show();
  dialog.showModal();
  search.focus();
}
