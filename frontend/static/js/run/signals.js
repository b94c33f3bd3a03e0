// @ts-check
import { limitOn } from "./limits.js";

/** @typedef {import("./store.js").Store} Store @typedef {import("./figure.js").Series} Series @typedef {import("./time_panel.js").Strip} Strip */

/** Inks of lines: the command is wide and pale, the measured signal thin and dark. Colour is left for margins (docs/decisions/0040). */
const COMMAND = { colour: "--ink-command", width: 4 };
const MEASURED = { colour: "--ink-line", width: 1.25 };
/** Lines of floors, from the top floor down: they differ by lightness, width and dash. @type {{colour: string, width: number, dash?: number[]}[]} */
const RANKED = [
  { colour: "--ink-line", width: 1.5 },
  { colour: "--ink-second", width: 1.5 },
  { colour: "--ink-command", width: 2.5 },
  { colour: "--ink-line", width: 1.25, dash: [5, 3] },
];
const MOST_FLOORS = 8;

/** The signals of a station: roles of their channels, with names where there are two; without a `title`, the label of the channel is the title. @type {Record<string, {title?: string, roles: [string, string, any][]}>} */
const SIGNALS = {
  displacement: { title: "Displacement", roles: [["x_cmd", "command", COMMAND], ["x_meas", "measured", MEASURED]] },
  error: { roles: [["error", "", MEASURED]] },
  ti: { roles: [["ti", "", MEASURED]] },
  d_alpha: { roles: [["d_alpha", "", MEASURED]] },
  force: { roles: [["f_meas", "", MEASURED]] },
  velocity: { roles: [["v_cmd", "", MEASURED]] },
  current: { roles: [["current", "", MEASURED]] },
  energy_error: { roles: [["energy_error", "", MEASURED]] },
};

/** Signals of a station that do not exist: without compensator, without controller. @param {any} station */
const absent = ({ compensator, controller }) => [compensator.kind === "none" ? "d_alpha" : "", (controller?.kind ?? "none") === "none" ? "current" : ""];

/** The strips of these signals of a station. @param {Store} store @param {any} plan @param {number} station from 0 @param {string[]} names @param {Record<string, any>} declared channels of the service @returns {Strip[]} */
export function stationStrips(store, plan, station, names, declared) {
  const without = absent(plan.stations[station]);
  return names
    .filter((name) => !without.includes(name))
    .map((name) => {
      const { title, roles } = SIGNALS[name];
      const series = roles.map(([role, label, style]) => ({ index: store.index(`${role}.${station + 1}`), label, unit: "", ...style }));
      const channels = series.map(({ index }) => store.channels[index]);
      channels.forEach(({ unit }, i) => (series[i].unit = unit));
      return { title: title ?? declared[roles[0][0]].label, unit: channels[0].unit, series, limit: limitOn(plan, channels[0]) };
    });
}

/** The displacements of the floors, at most eight of a tall structure. @param {Store} store @returns {Strip[]} */
export function floorStrips(store) {
  const floors = store.channels.filter((channel) => channel.role === "x_floor");
  if (!floors.length) return [];
  const count = Math.min(floors.length, MOST_FLOORS);
  const some = Array.from({ length: count }, (_, i) => floors[Math.round(((i + 1) * floors.length) / count) - 1]);
  const series = some.map(({ key, number, unit }, i) => ({ index: store.index(key), label: `floor ${number}`, unit, ...RANKED[(count - 1 - i) % RANKED.length] }));
  const title = "Floor displacement relative to the ground";
  return [{ title: count < floors.length ? `${title}, ${count} of ${floors.length}` : title, unit: floors[0].unit, series }];
}

/** The excitation: ground acceleration and forces on floors. @param {Store} store @param {any} plan @returns {Strip[]} */
export function inputStrips(store, plan) {
  const still = plan.motion.kind === "none";
  const channels = store.channels.filter(({ role }) => role === "force_ext" || (role === "ag" && !still));
  return channels.map(({ key, label, unit }) => ({ title: label, unit, series: [{ index: store.index(key), label: "", unit, ...MEASURED }] }));
}

/** Two signals of a station for a loop. @param {Store} store @param {any} plan @param {number} station from 0 @param {[string, string]} x role and label @param {[string, string]} y @returns {(Series & {limit: number | null})[]} */
export const pair = (store, plan, station, x, y) =>
  [x, y].map(([role, label]) => {
    const index = store.index(`${role}.${station + 1}`);
    return { index, label, unit: store.channels[index].unit, colour: "--ink-line", limit: limitOn(plan, store.channels[index]) };
  });
