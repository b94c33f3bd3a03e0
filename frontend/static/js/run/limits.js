// @ts-check
/** @typedef {import("./store.js").Channel} Channel */

/** A quantity of a station with its safety limit in the unit shown, or without a limit (null). @typedef {{index: number, label: string, unit: string, limit: number | null}} Limited */

/** The limits of a plan that a channel is checked against: field of the plan, role of the channel, label. Same order as the gauges. */
const CHECKED = [
  ["displacement", "x_cmd", "Command stroke"],
  ["velocity", "v_cmd", "Command velocity"],
  ["force", "f_meas", "Force"],
];

/** The limited quantities of a station. @param {any} plan @param {Channel[]} channels @param {number} station from 0 @returns {Limited[]} */
export function limited(plan, channels, station) {
  return CHECKED.map(([field, role, label]) => {
    const index = channels.findIndex((one) => one.role === role && one.number === station + 1);
    const { unit, factor } = channels[index];
    return { index, label, unit, limit: plan.stations[station].limits[field] / factor };
  });
}

/** The limit on a channel in the unit shown, or null. @param {any} plan @param {Channel} channel */
export function limitOn(plan, { role, number, factor }) {
  const field = { x_cmd: "displacement", x_meas: "displacement", v_cmd: "velocity", f_meas: "force" }[role];
  return field && number ? plan.stations[number - 1].limits[field] / factor : null;
}

/**
 * The value that tripped a run, where a gauge shows it: the run ends before that sample is recorded.
 * @param {any} trip @param {number} station from 0 @param {number} quantity position in `limited` @param {number} factor @returns {number | null}
 */
export function tripped(trip, station, quantity, factor) {
  if (!trip || trip.station !== station + 1 || trip.limit !== CHECKED[quantity][0]) return null;
  return trip.value === null ? Infinity : trip.value / factor;
}
