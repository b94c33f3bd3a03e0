// @ts-check
import { el } from "../dom.js";
import { downloadMenu } from "../downloads.js";
import { ended } from "./facts.js";

/**
 * The button that cancels a test which has not ended; `refusal` says why the person may not.
 * @param {any} run @param {(button: HTMLButtonElement) => void} stop @param {string | undefined} refusal @returns {HTMLElement[]}
 */
export function cancelling(run, stop, refusal) {
  if (ended(run.state)) return [];
  const withheld = run.state === "to approve" ? undefined : refusal; // who submitted it withdraws it, and drives nothing
  const cancel = el("button", { type: "button", class: "quiet stop", "data-needs": "operator", disabled: Boolean(withheld), title: withheld, on: { click: () => stop(cancel) } }, run.state === "to approve" ? "Withdraw this test" : "Cancel this test");
  return [cancel];
}

/** The links of a run. @param {any} run @returns {HTMLElement[]} */
export function actions(run) {
  const address = `/api/v1/runs/${run.id}`;
  const link = (/** @type {string} */ href, /** @type {string} */ label, /** @type {string | false} */ needs = false) => el("a", { href, class: "button quiet", "data-needs": needs }, label);
  const driven = run.test !== "hybrid" && run.test !== "structure"; // no structure is computed
  /** @type {import("../downloads.js").Download} */
  const measures = ["Measures, CSV", `${address}/measures.csv`, true];
  /** @type {import("../downloads.js").Download[]} */
  const recorded = [
    ["Report, HTML", `${address}/report.html`],
    ["Report, PDF", `${address}/report.pdf`],
    ["Report with plots that zoom, 5 MB", `${address}/report.html?interactive=true`],
    ["Recording, HDF5", `${address}/recording.h5`, true],
    ["Recording, CSV", `${address}/recording.csv`, true],
    ["Recording, MATLAB", `${address}/recording.mat`, true],
    measures,
    ["Data set for DesignSafe", `/runs/${run.id}/designsafe`],
  ];
  return [
    downloadMenu([...(run.recording ? recorded : run.recording_removed_at ? [measures] : []), ["Plan, YAML", `${address}/plan.yaml`, true]]),
    ...(driven ? [] : [link(`/stability/${run.id}`, "Stability")]),
    ...(run.recording ? [link(`/diagnoses?run=${run.id}`, "Diagnose this run", "engineer")] : []),
    ...(run.recording ? [link(`/compare/previous/${run.id}`, "Compare with the previous run"), link(`/compare?items=run:${run.id}`, "Compare with other runs")] : []),
    link(`/new?from=${run.id}`, "Edit and run again", "engineer"),
    ...(run.test === "client" ? [] : [link(`/sweeps/new?run=${run.id}`, "Sweep this plan", "engineer")]),
  ];
}
