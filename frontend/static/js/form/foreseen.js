// @ts-check
import { el } from "../dom.js";
import { against, marginOf, percent } from "./peaks.js";

/**
 * Show beside each field with a bound what the dry run reaches, and the trip beside the field of its limit.
 * @param {HTMLElement} host of the form @param {any | null} found preflight; null takes all words away
 */
export function showForeseen(host, found) {
  for (const old of host.querySelectorAll("small.foreseen")) old.remove();
  for (const fold of host.querySelectorAll("details.fold")) {
    fold.removeAttribute("data-margin");
    say(fold, found?.trip?.station - 1 === Number(/** @type {HTMLElement} */ (fold).dataset.station) ? "would trip" : "");
  }
  if (!found) return;
  for (const use of found.uses) {
    if (use.against === "rig") continue;
    const tripped = use.path === found.trip?.path;
    note(use.path, tripped ? "over" : marginOf(use).level, tripped ? tripWords(found, use) : `Dry run: ${against(use)}, ${percent(use)}`);
    if (use.against === "limit") worsen(host, use);
  }
}

/** @param {any} found @param {any} use */
function tripWords({ trip }, use) {
  const beyond = trip.sentence.match(/[^ ]+ > .*(?=\.$)/)?.[0] ?? "its value is not a number";
  return `Would trip at ${trip.time_s.toFixed(2)} s: ${beyond}. Without limits: ${against(use)}, ${percent(use)}`;
}

/** @param {Element} fold @param {string} words */
function say(fold, words) {
  const place = fold.querySelector(".fold-trip");
  if (place) place.textContent = words;
}

/** @param {string} path @param {string} level @param {string} words */
function note(path, level, words) {
  const place = document.getElementById(`e-${path}`);
  if (place) place.after(el("small", { class: "foreseen", "data-margin": level }, words));
}

const RANK = ["none", "ok", "near", "over"];

/** Give the fold of a station the smallest margin of its limits. @param {HTMLElement} host @param {any} use */
function worsen(host, use) {
  const fold = /** @type {HTMLElement | null} */ (host.querySelector(`details.fold[data-station="${use.station - 1}"]`));
  if (!fold) return;
  const { level } = marginOf(use);
  if (RANK.indexOf(level) > RANK.indexOf(fold.dataset.margin ?? "none")) fold.dataset.margin = level;
}
