// @ts-check
import { ApiError, api, explain } from "../api.js";

const AGAIN_MS = 5000;
const TRIES = 6;

/** @type {Outcome} */
const NOTHING = { found: null, failed: "" };

/**
 * The preflight of the plan in the form, after each valid check. Answers to older plans are dropped.
 * @typedef {{found: any | null, failed: string}} Outcome `failed` says why there is no preflight
 */
export class Foresight {
  /** @param {(outcome: Outcome | null) => void} tell null: a dry run is under way */
  constructor(tell) {
    this.tell = tell;
    this.asking = new AbortController();
    this.text = ""; // the plan and the rig that were asked about last, as JSON
    /** @type {Promise<Outcome>} */
    this.answer = Promise.resolve(NOTHING);
  }

  /** The preflight of a valid plan on a rig. A plan that was asked about last is not asked about again. @param {any} plan @param {string} rig @returns {Promise<Outcome>} */
  of(plan, rig) {
    const asked = { plan, rig };
    const text = JSON.stringify(asked);
    if (text !== this.text) {
      this.drop();
      this.text = text;
      this.answer = this.#answer(asked, (this.asking = new AbortController()).signal);
    }
    return this.answer;
  }

  /** Forget the outcome: the plan has changed or is not valid. */
  drop() {
    this.asking.abort();
    this.text = "";
    this.answer = Promise.resolve(NOTHING);
  }

  /** @param {{plan: any, rig: string}} asked @param {AbortSignal} signal */
  async #answer(asked, signal) {
    this.tell(null);
    const outcome = await this.#ask(asked, signal);
    if (signal.aborted) return NOTHING;
    if (outcome.failed) this.text = ""; // the next time it is asked again
    this.tell(outcome);
    return outcome;
  }

  /** Ask the service; again where it is busy. @param {{plan: any, rig: string}} asked @param {AbortSignal} signal @returns {Promise<Outcome>} */
  async #ask(asked, signal, tries = TRIES) {
    try {
      return { found: await api.post("/plans/preflight", asked, signal), failed: "" };
    } catch (error) {
      if (signal.aborted) return NOTHING;
      if (tries > 1 && error instanceof ApiError && error.status === 503) {
        await new Promise((done) => setTimeout(done, AGAIN_MS));
        return this.#ask(asked, signal, tries - 1);
      }
      return { found: null, failed: error instanceof ApiError ? error.message : explain(error) };
    }
  }
}
