// @ts-check
import { api, explain } from "../api.js";
import { el, renew } from "../dom.js";
import { fixed, significant } from "../format.js";

const NOTHING = 1e-3; // of a shown unit: a dead time below a microsecond is none
const OFFER = "Identify delay by a short random test";

/** Offer to identify the delay of a station beside its compensator. @param {HTMLElement} fields of the station @param {number} index from 0 @param {() => any} read the plan in the form */
export function offerIdentification(fields, index, read) {
  const compensator = fields.querySelector(`[data-path="stations.${index}.compensator"]`);
  if (!compensator) return;
  const answer = el("div", { class: "identified", role: "status" });
  const button = el("button", { type: "button", class: "quiet small" }, OFFER);
  button.addEventListener("click", async () => {
    button.disabled = true;
    renew(answer, el("p", { class: "muted" }, "Random test of 20 s in simulated time at a small amplitude, and the same at a quarter of it …"));
    try {
      const found = await api.post("/plans/identify", { plan: read(), station: index + 1 });
      renew(answer, ...identified(found));
    } catch (error) {
      renew(answer, el("p", { class: "problem" }, `Not identified: ${explain(error)}`));
    }
    button.disabled = false;
    button.focus();
  });
  compensator.append(el("div", { class: "identify" }, button, answer));
}

/** The estimate with its interval, the three models, and a button that writes it into the compensator. @param {any} found */
function identified(found) {
  const best = found.models.find((/** @type {any} */ one) => one.kind === found.best);
  const peak = `${significant(1e3 * found.amplitude)} mm`;
  const first = `Delay ${interval(found.delay, 1e-3, "ms")} by the model “${best.title}”. Noise of ${found.low_frequency} to ${found.high_frequency} Hz with a peak of ${peak}, mean coherence ${fixed(found.coherence, 3)}.`;
  const head = ["Model", "Parameters", "Delay, ms", "Residual, %"].map((text) => el("th", { scope: "col" }, text));
  const rows = found.models.map((/** @type {any} */ one) =>
    el("tr", {}, el("th", { scope: "row" }, one.title), el("td", {}, parameters(one)), el("td", {}, interval(one.delay, 1e-3)), el("td", {}, significant(100 * one.residual, 2))),
  );
  const table = el("div", { class: "scroll", tabindex: "0", role: "group", "aria-label": "Fitted models" }, el("table", {}, el("thead", {}, el("tr", {}, ...head)), el("tbody", {}, ...rows)));
  const notes = found.notes.length ? el("ul", {}, ...found.notes.map((/** @type {string} */ note) => el("li", {}, note))) : null;
  return [el("p", {}, first), table, notes, suggestion(found.suggested)].filter((one) => one !== null);
}

/** @param {any[]} suggested */
function suggestion(suggested) {
  if (!suggested.length) return null;
  const items = suggested.map((one) => el("li", {}, `${one.label}: ${shown(one, one.value)} (now ${shown(one, one.present)})`));
  const button = el("button", { type: "button", class: "small" }, "Write estimate into the compensator");
  const state = el("p", { class: "muted", role: "status" });
  button.addEventListener("click", () => {
    const missing = suggested.filter((one) => !write(one));
    state.textContent = missing.length ? "The compensator has changed since. Identify the delay again." : "Written into the fields above.";
  });
  return el("div", { class: "suggested" }, el("ul", {}, ...items), button, state);
}

/** Write a value into its field. Returns whether the field is there. @param {any} one */
function write(one) {
  const control = document.getElementById(`f-${one.path}`);
  if (!(control instanceof HTMLInputElement)) return false;
  control.value = significant(one.value / one.factor, 5);
  for (const event of ["input", "change"]) control.dispatchEvent(new Event(event, { bubbles: true }));
  return true;
}

/** @param {any} one @param {number} value SI */
const shown = (one, value) => `${Math.abs(value / one.factor) < NOTHING ? 0 : significant(value / one.factor)} ${one.shown_label}`.trim();

/** `28.3 (28.2 to 28.4)`. @param {{value: number, low: number, high: number}} estimate @param {number} factor */
function interval({ value, low, high }, factor, unit = "") {
  const digits = Math.max(3, Math.min(4, Math.ceil(Math.log10(Math.abs(value) / Math.max(high - low, 1e-12))) + 1));
  const [middle, from, to] = [value, low, high].map((one) => significant(one / factor, digits));
  return unit ? `${middle} ${unit} (95 % interval ${from} to ${to} ${unit})` : `${middle} (${from} to ${to})`;
}

/** @param {any} model */
const parameters = (model) => model.parameters.map((/** @type {any} */ one) => `${one.label} ${one.determined ? shown(one, one.value) : "not determined"}`).join(", ");
