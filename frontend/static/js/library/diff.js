// @ts-check
import { api } from "../api.js";
import { byId, el } from "../dom.js";
import { tableOf } from "./words.js";

/** @typedef {{title: string, unit: string, texts: [string, string]}} Row @typedef {{label: string}} Item */

/** Show the fields in which two plans differ in #differences. @param {string} first @param {string} second */
export async function showDifferences(first, second) {
  const query = new URLSearchParams({ first, second });
  const { items, differences } = await api.get(`/library/differences?${query}`);
  byId("differences-title").textContent = `Differences from ${items[0].label.toLowerCase()} to ${items[1].label.toLowerCase()}`;
  byId("differences").replaceChildren(differences.length ? table(items, differences) : el("p", { class: "empty" }, "The two plans are equal."));
  byId("differences-part").hidden = false;
}

/** @param {Item[]} items @param {Row[]} rows */
function table(items, rows) {
  const body = rows.map(({ title, unit, texts }) =>
    el(
      "tr",
      {},
      el("th", { scope: "row" }, title),
      el("td", { class: "number was", "data-label": items[0].label }, texts[0]),
      el("td", { class: "number is", "data-label": items[1].label }, texts[1]),
      el("td", { class: "muted", "data-label": "Unit" }, unit || "–"),
    ),
  );
  return tableOf("Differences between the plans", ["Field", `#${items[0].label}`, `#${items[1].label}`, "Unit"], body);
}
