// @ts-check
import { el } from "../dom.js";
import { peaksOf } from "./peaks.js";
import { showForeseen } from "./foreseen.js";

/** Where the preflight of the draft is shown: its sentence in the bar, its peaks beside the form, its words beside the fields. */
export class Outlook {
  /** @param {HTMLElement} sentence @param {HTMLElement} peaks @param {HTMLElement} plan @param {import("./sketch.js").Sketch} sketch */
  constructor(sentence, peaks, plan, sketch) {
    this.sentence = sentence;
    this.peaks = peaks;
    this.plan = plan;
    this.sketch = sketch;
  }

  /** Show an outcome; null while a dry run is under way. @param {import("./foresight.js").Outcome | null} outcome */
  show(outcome) {
    this.peaks.toggleAttribute("data-stale", !outcome);
    if (!outcome) return this.#say("muted", "Dry run under way …");
    const { found, failed } = outcome;
    showForeseen(this.plan, found);
    this.sketch.foresee(found);
    if (!found) {
      this.#say("muted", failed ? `No dry run: ${failed}` : "");
      this.peaks.replaceChildren(el("p", { class: "muted" }, failed || "The peaks appear after the next dry run."));
      return;
    }
    this.#say(found.trip || found.verdict === "refused" ? "trips" : found.verdict === "completes" ? "" : "muted", found.sentence);
    this.peaks.replaceChildren(...peaksOf(found));
  }

  /** The plan has errors. */
  clear() {
    this.show({ found: null, failed: "" });
    this.peaks.replaceChildren(el("p", { class: "muted" }, "The dry run follows when the plan has no errors."));
  }

  /** @param {string} kind @param {string} words */
  #say(kind, words) {
    this.sentence.className = kind;
    if (this.sentence.textContent !== words) this.sentence.textContent = words;
  }
}
