// @ts-check
import { el } from "../dom.js";
import { LoopChart } from "./loop_chart.js";
import { Tiles } from "./tiles.js";
import { TimeChart } from "./time_chart.js";
import { View } from "./view.js";

/** @typedef {import("./store.js").Store} Store @typedef {import("./store.js").Channel} Channel */

const COLOURS = ["--line-1", "--line-2", "--line-3", "--line-4"];
const MOST_FLOORS = 8;

/** Charts of a station: signals against time (`keys`), or one signal (y) against another (x). Without a `title`, the channel's label is the title. */
const CHARTS = {
  displacement: { title: "Displacement", keys: ["x_cmd", "x_meas"], labels: ["command", "measured"] },
  force: { keys: ["f_meas"], labels: [""] },
  current: { keys: ["current"], labels: [""] },
  error: { keys: ["error"], labels: [""] },
  ti: { keys: ["ti"], labels: [""] },
  d_alpha: { keys: ["d_alpha"], labels: [""] },
  energy_error: { keys: ["energy_error"], labels: [""] },
  hysteresis: { title: "Force against displacement", x: ["x_meas", "displacement"], y: ["f_meas", "force"] },
  subspace: { title: "Synchronisation subspace", x: ["x_cmd", "command"], y: ["x_meas", "measured"], alike: true },
};

/** The charts of a station in each kind of test, and the charts that are large. @type {Record<string, {head: string, charts: (keyof typeof CHARTS)[], large: Record<string, string>}>} */
const SHOWN = {
  hybrid: { head: "Station", charts: ["displacement", "hysteresis", "current", "error", "subspace", "ti", "d_alpha", "energy_error"], large: { displacement: "double" } },
  specimen: { head: "Specimen", charts: ["hysteresis", "displacement", "force", "current", "error"], large: { hysteresis: "square", displacement: "double" } },
  actuator: { head: "Actuator", charts: ["displacement", "subspace", "error", "force", "current", "ti", "d_alpha"], large: { displacement: "wide" } },
};

/** Build the charts of a test in `host`. The view draws the charts, the tiles show the measures. @param {HTMLElement} host @param {Store} store @param {any} plan @param {{measures: import("./measures.js").Measure[], channels: Record<string, any>}} declared */
export function buildCharts(host, store, plan, declared) {
  const view = new View(store);
  const tiles = new Tiles(plan, declared.measures);
  const series = (/** @type {string} */ key, /** @type {string} */ label, /** @type {number} */ i) => {
    const index = store.index(key);
    return { index, label, unit: store.channels[index].unit, colour: COLOURS[i % COLOURS.length] };
  };
  const shown = SHOWN[plan.test] ?? SHOWN.hybrid;
  const sections = plan.stations.map((/** @type {any} */ station, /** @type {number} */ i) => {
    const without = [station.compensator.kind === "none" ? "d_alpha" : "", (station.controller?.kind ?? "none") === "none" ? "current" : ""];
    const wanted = shown.charts.filter((name) => !without.includes(name));
    const charts = wanted.map((name) => {
      const given = /** @type {any} */ (CHARTS[name]);
      const chart = stationChart(view, { title: declared.channels[given.keys?.[0]]?.label, ...given }, i + 1, series);
      if (shown.large[name]) chart.figure.element.classList.add(shown.large[name]);
      return chart;
    });
    const title = plan.stations.length > 1 ? `${shown.head} ${i + 1}: ${station.name}` : `${shown.head}: ${station.name}`;
    return section(title, tiles.stations[i].element, charts);
  });
  const alone = plan.test === "structure";
  const rest = [structure(view, store, series, tiles.structure.element, alone), inputs(view, store, series, plan)];
  host.replaceChildren(...sections, ...rest.filter((one) => one !== null));
  return { view, tiles };
}

/** @param {View} view @param {any} chart @param {number} number @param {(key: string, label: string, i: number) => any} series */
function stationChart(view, { title, keys, labels, x, y, alike }, number, series) {
  if (x) return new LoopChart(view, title, series(`${x[0]}.${number}`, x[1], 0), series(`${y[0]}.${number}`, y[1], 0), alike);
  const lines = keys.map((/** @type {string} */ key, /** @type {number} */ j) => series(`${key}.${number}`, labels[j], j));
  if (lines.length > 1) Object.assign(lines[0], { width: 4, colour: "--line-wide" }); // visible behind the measured line
  return new TimeChart(view, title, lines[0].unit, lines);
}

/** The chart of floor displacements: at most eight floors of a tall structure, and large if nothing else is measured. @param {View} view @param {Store} store @param {(key: string, label: string, i: number) => any} series @param {HTMLElement} tiles @param {boolean} alone */
function structure(view, store, series, tiles, alone) {
  const floors = store.channels.filter((channel) => channel.role === "x_floor");
  if (!floors.length) return null;
  const count = Math.min(floors.length, MOST_FLOORS);
  const some = Array.from({ length: count }, (_, i) => Math.round(((i + 1) * floors.length) / count) - 1);
  const lines = some.map((floor, i) => series(floors[floor].key, `floor ${floor + 1}`, i));
  const title = "Floor displacement relative to the ground";
  const chart = new TimeChart(view, count < floors.length ? `${title}, ${count} of ${floors.length}` : title, lines[0].unit, lines);
  if (alone) chart.figure.element.classList.add("wide");
  return section("Structure", tiles, [chart]);
}

/** The charts of the excitation: ground acceleration and forces on floors. @param {View} view @param {Store} store @param {(key: string, label: string, i: number) => any} series @param {any} plan */
function inputs(view, store, series, plan) {
  const still = plan.motion.kind === "none";
  const channels = store.channels.filter(({ role }) => role === "force_ext" || (role === "ag" && !still));
  if (!channels.length) return null;
  return section("Excitation", null, channels.map((channel) => {
    const line = series(channel.key, "", 0);
    return new TimeChart(view, channel.label, line.unit, [line]);
  }));
}

/** @param {string} title @param {HTMLElement | null} tiles @param {{figure: {element: HTMLElement}}[]} charts */
function section(title, tiles, charts) {
  return el("section", {}, el("h2", {}, title), tiles, el("div", { class: "charts" }, ...charts.map((chart) => chart.figure.element)));
}
