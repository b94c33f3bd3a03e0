// @ts-check
import { el } from "../dom.js";
import { fixed, number, size, when } from "../format.js";
import { of } from "./measures.js";

/** @typedef {import("./measures.js").Measure} Measure */

const KINDS = { hybrid: "hybrid", specimen: "specimen alone", actuator: "actuator alone", structure: "structure alone", client: "with a client" };
const COMPUTED = ["hybrid", "structure"]; // kinds of test with a structure
const ENDED = ["completed", "tripped", "cancelled", "failed"];

/** @param {string} state */
export const ended = (state) => ENDED.includes(state);

/** The facts of a run besides the tables of measures, as terms and values. @param {any} run @param {Measure[]} measures @returns {HTMLElement[]} */
export function facts(run, measures) {
  const rows = [
    ["Submitted", `${when(run.submitted_at)} by ${run.submitted_by || "unknown"}`],
    ["Started", when(run.started_at)],
    ["Ended", when(run.finished_at)],
    ["Kind of test", KINDS[/** @type {keyof typeof KINDS} */ (run.test)]],
    ...(run.plan ? excitation(run.plan) : []),
    ["External stations", run.external?.join(" ")],
    ["Template", run.template],
    ["Plan in the library", run.library_id && el("a", { href: `/plans/${run.library_id}` }, `opened from version ${run.library_version}`)],
    ["Seed", run.seed],
    ["Attempt", run.attempt > 1 ? `${run.attempt} (the worker or the engine stopped during the previous attempt)` : null],
    ["Plan digest", run.digest],
    ["Code version", version(run)],
    ...of(measures, "floor", run.test).map((one) => ofFloors(run, one)),
    ...of(measures, "run", run.test).map((one) => ofTest(run, one)),
    ["Recording", run.recording ? `${size(run.recording.size)}, SHA-256 ${run.recording.sha256}` : removed(run)],
  ];
  return rows
    .filter(([, value]) => value != null && value !== "" && value !== "–")
    .flatMap(([term, value]) => [el("dt", {}, term), value instanceof Node ? el("dd", {}, value) : el("dd", { title: value }, String(value))]);
}

/** The version of the program that executed a run, and the one that queued it where that is another. @param {any} run */
function version({ code_version, started_version }) {
  return !started_version || started_version === code_version ? code_version : `${started_version} (queued by version ${code_version})`;
}

/** A measure of the floors that no table shows. @param {any} run @param {Measure} measure @returns {[string, string | null]} */
const ofFloors = (run, { key, label, decimals, shown_label }) => [
  label,
  run.stations?.length && run[key]?.length ? `${run[key].map((/** @type {number} */ value) => fixed(value, decimals)).join(", ")} ${shown_label}` : null,
];

/** A measure of the whole test that no tile shows. @param {any} run @param {Measure} measure @returns {[string, string | null]} */
const ofTest = (run, { key, label, decimals, shown_label }) => [
  label,
  COMPUTED.includes(run.test) || run[key] == null ? null : `${fixed(run[key], decimals)} ${shown_label}`,
];

/** The excitation of the test. @param {any} plan @returns {[string, string | null][]} */
function excitation({ motion, drive, forces = [], start }) {
  const drawn = (/** @type {any} */ { amplitude, shape }, /** @type {number} */ factor, /** @type {string} */ unit) =>
    `${number(amplitude / factor)} ${unit}, ${shape.kind.replaceAll("_", " ")}`;
  const mm = (/** @type {number[] | undefined} */ values, /** @type {string} */ unit) =>
    values?.some(Boolean) ? `${values.map((value) => number(1000 * value, 3)).join(", ")} ${unit}` : null;
  return [
    ["Drive", drive && drive.shape.kind !== "still" ? drawn(drive, 1e-3, "mm") : null],
    ["Record", motion.kind === "none" ? null : record(motion)],
    ...forces.map((/** @type {any} */ force) => [`Force on floor ${force.floor}`, drawn(force, 1e3, "kN")]),
    ["Start displacements", mm(start?.displacement, "mm")],
    ["Start velocities", mm(start?.velocity, "mm/s")],
  ];
}

/** @param {any} planned */
function record(planned) {
  const { scale } = planned;
  const how = { factor: `× ${scale?.factor}`, pga: `scaled to PGA ${fixed(scale?.pga / 9.80665, 3)} g`, sa_t1: `scaled to Sa(T1) ${fixed(scale?.sa / 9.80665, 3)} g` };
  return `${planned.record ?? "written in the plan"} ${how[/** @type {keyof typeof how} */ (scale?.kind)] ?? ""}`;
}

/** The reason why a run ended, or null if the run completed or has not ended. @param {any} run */
export function reason(run) {
  if (run.trip?.sentence) return run.trip.sentence;
  if (run.state === "completed" || !ended(run.state)) return null;
  return run.reason || run.state;
}

/** When retention removed the recording of a run, in words; null where it did not. @param {any} run */
export const removed = ({ recording_removed_at }) => recording_removed_at && `removed by retention on ${when(recording_removed_at).slice(0, 10)}`;

/** What stands in place of the test before its signals arrive. @param {any} run */
export function awaited(run) {
  const { state, recording } = run;
  if (state === "to approve") return "The test waits until another person approves it on the page Queue.";
  if (state === "queued") return "The drawing, the gauges and the charts appear here when the test starts.";
  if (run.recording_removed_at) return `Recording ${removed(run)}. The plan and the measures are kept.`;
  return ended(state) && !recording ? "This run has no recording, so there is nothing to draw. Edit the plan and run it again." : "Loading the signals of the test …";
}

/** Simulated time, elapsed time and speed as text; without `duration_s` where a client ends the test. @param {any} at @returns {string} */
export function clock({ simulated_s, duration_s, elapsed_s, timing }) {
  const parts = [`${fixed(simulated_s, 2)}${duration_s === null ? "" : ` of ${fixed(duration_s, 2)}`} s simulated`];
  if (elapsed_s >= 0.01) parts.push(`${number(elapsed_s, 3)} s elapsed`, `${number(simulated_s / elapsed_s, 3)} × real time`);
  if (timing) parts.push(`${timing.missed} ${timing.missed === 1 ? "deadline" : "deadlines"} missed`);
  return parts.join(" · ");
}
