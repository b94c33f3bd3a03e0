// @ts-check
import { api } from "../api.js";

/** @typedef {{term: string, symbol: string, unit: string, meaning: string}} Term */

const LABELS = "th, dt, label, legend, h2, h3, figcaption strong, .gauge-label, .card-curve > span, .entry";
const LONGEST = 60; // characters of a label; longer text is a sentence

/** @type {Promise<Map<string, Term>> | null} */
let loading = null;

/** The glossary by term and by symbol. */
export function glossary() {
  loading ??= api.get("/glossary").then(({ terms }) => {
    /** @type {Map<string, Term>} */
    const found = new Map();
    for (const one of terms) for (const name of [one.symbol, one.term]) if (name) found.set(plain(name), one);
    return found;
  });
  return loading;
}

/** The term that an element or its surroundings name, or null. @param {Element | null} element @param {Map<string, Term>} terms @returns {Term | null} */
export function termOf(element, terms) {
  const label = element?.closest(LABELS);
  const text = label?.textContent?.trim() ?? "";
  if (!text || text.length > LONGEST) return null;
  return terms.get(plain(text)) ?? null;
}

/** The terms on the page, in their order, each once. @param {Map<string, Term>} terms @returns {Term[]} */
export function termsOnPage(terms) {
  const found = [...document.querySelectorAll(LABELS)].filter((one) => one.checkVisibility()).map((one) => termOf(one, terms));
  return [...new Set(found.filter((one) => one !== null))];
}

/** A label without its unit, station number and values. @param {string} text */
const plain = (text) =>
  text
    .replace(/\s+/g, " ")
    .replace(/(,| \().*$/, "")
    .replace(/^\d+: /, "")
    .trim()
    .toLowerCase();
