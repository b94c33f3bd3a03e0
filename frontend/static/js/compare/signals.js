// @ts-check
import { ApiError } from "../api.js";
import { noteSignIn } from "../signed_out.js";

/**
 * One signal of an item: smallest and largest values of equal parts (`envelope`), or every n-th sample (`samples`).
 * @typedef {{item: number, role: string, form: "envelope" | "samples", start_s: number, step_s: number, count: number, values: Float32Array}} Series
 */

/** The signals of all items, by item and role. */
export class Signals {
  /** @param {Series[]} series */
  constructor(series) {
    /** @type {Map<string, Series>} */
    this.found = new Map(series.map((one) => [`${one.form} ${one.item} ${one.role}`, one]));
  }

  /** @param {number} item @param {string} role @param {"envelope" | "samples"} [form] */
  get(item, role, form = "envelope") {
    return this.found.get(`${form} ${item} ${role}`);
  }

  /** Whether any item has the role. @param {string} role */
  has(role) {
    return [...this.found.keys()].some((key) => key.endsWith(` ${role}`));
  }

  /** Whether a role is zero in all items, as the adaptation of compensators that do not adapt. @param {string} role */
  still(role) {
    return [...this.found.values()].every((one) => one.role !== role || one.values.every((value) => value === 0));
  }
}

/** @param {ArrayBuffer} body a uint32 length, a JSON head of that length, float32 values */
export function unpack(body) {
  const length = new DataView(body).getUint32(0, true);
  const { series } = JSON.parse(new TextDecoder().decode(new Uint8Array(body, 4, length)));
  let at = 4 + length;
  for (const one of series) {
    one.values = new Float32Array(body, at, one.count);
    at += 4 * one.count;
  }
  return new Signals(series);
}

/** Ask the service for signals. @param {URLSearchParams} query @param {AbortSignal} [signal] */
export async function fetchSignals(query, signal) {
  const response = noteSignIn(await fetch(`/api/v1/compare/signals?${query}`, { signal }));
  if (response.ok) return unpack(await response.arrayBuffer());
  const problem = await response.json().catch(() => ({}));
  throw new ApiError(response.status, problem.detail ?? `The service answered with the HTTP status ${response.status}.`, problem.errors);
}

/** The value at a time, NaN outside the samples. @param {Series | undefined} series @param {number} time */
export function valueAt(series, time) {
  if (!series) return NaN;
  const k = Math.round((time - series.start_s) / series.step_s);
  return k >= 0 && k < series.count ? series.values[k] : NaN;
}

/** The first and the last place between two times, with one more at each end. @param {Series} series @param {[number, number]} range */
export function within(series, [from, to]) {
  const first = Math.max(0, Math.floor((from - series.start_s) / series.step_s));
  const end = Math.min(series.count, Math.ceil((to - series.start_s) / series.step_s) + 1);
  return [first, Math.max(first, end)];
}
