// @ts-check
import { ask } from "../ask.js";
import { el } from "../dom.js";

/** Whether a plan goes to the queue: one that would trip, or whose dry run failed, only after a dialog. @param {import("./foresight.js").Outcome} outcome @returns {Promise<boolean>} */
export async function confirmed({ found, failed }) {
  if (failed) return ask({ title: "Queue the test without a dry run?", text: failed, yes: "Queue without a dry run", no: "Back to the form" });
  if (!found?.trip || found.verdict === "refused") return true; // a submission says what the rig refuses
  const beyond = found.uses.filter((/** @type {any} */ use) => use.against === "limit" && use.beyond_s !== null);
  const others = beyond.filter((/** @type {any} */ use) => use.path !== found.trip.path);
  const text = el(
    "div",
    {},
    el("p", { class: "trips" }, found.sentence),
    el("p", {}, "The test would end there. Its recording is kept."),
    others.length ? el("p", { class: "muted" }, `Also exceeded without limits: ${others.map((/** @type {any} */ use) => `${use.label} of station ${use.station}`).join(", ")}.`) : null,
  );
  return ask({ title: "This test would trip", text, yes: "Queue the test that would trip", no: "Back to the form", danger: true });
}
