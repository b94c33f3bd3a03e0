// @ts-check
import { el } from "../dom.js";
import { ended } from "./facts.js";

/** The button that cancels a test which has not ended. @param {any} run @param {(button: HTMLButtonElement) => void} stop @returns {HTMLElement[]} */
export function cancelling(run, stop) {
  if (ended(run.state)) return [];
  const cancel = el("button", { type: "button", class: "quiet stop", on: { click: () => stop(cancel) } }, "Cancel this test");
  return [cancel];
}

/** The links of a run. @param {any} run @returns {HTMLElement[]} */
export function actions(run) {
  const address = `/api/v1/runs/${run.id}`;
  const link = (/** @type {string} */ href, /** @type {string} */ label, /** @type {boolean} */ saved = false) => el("a", { href, class: "button quiet", download: saved }, label);
  const driven = run.test === "specimen" || run.test === "actuator";
  const recorded = run.recording
    ? [
        link(`${address}/recording.h5`, "Recording, HDF5", true),
        link(`${address}/recording.csv`, "Recording, CSV", true),
        link(`${address}/measures.csv`, "Measures, CSV", true),
        link(`${address}/report.html`, "Report"),
      ]
    : [];
  return [
    ...recorded,
    link(`${address}/plan.yaml`, "Plan, YAML", true),
    ...(driven ? [] : [link(`/stability/${run.id}`, "Stability")]),
    ...(run.recording ? [link(`/diagnoses?run=${run.id}`, "Diagnose this run")] : []),
    ...(run.recording ? [link(`/compare/previous/${run.id}`, "Compare with the previous run"), link(`/compare?items=run:${run.id}`, "Compare with other runs")] : []),
    link(`/new?from=${run.id}`, "Edit and run again"),
  ];
}
