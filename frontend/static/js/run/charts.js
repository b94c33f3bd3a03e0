// @ts-check
import { el } from "../dom.js";
import { LoopChart } from "./loop_chart.js";
import { floorStrips, inputStrips, pair, stationStrips } from "./signals.js";
import { FIRST } from "./stage.js";
import { Tiles } from "./tiles.js";
import { TimeChart } from "./time_chart.js";

/** @typedef {import("./view.js").View} View @typedef {import("./time_panel.js").Strip} Strip */

/** The signals of a station in each kind of test. */
const SIGNALS = {
  hybrid: ["displacement", "error", "ti", "d_alpha", "force", "velocity", "current", "energy_error"],
  specimen: ["displacement", "force", "error", "velocity", "current"],
  actuator: ["displacement", "error", "ti", "d_alpha", "force", "velocity", "current"],
  structure: [],
  client: ["displacement", "force", "error", "ti", "d_alpha", "velocity", "current", "energy_error"],
};
const HEAD = { hybrid: "Station", specimen: "Specimen", actuator: "Actuator", structure: "", client: "Station" };

/**
 * The charts below the first screen. With one station they are those that the first screen does not show; with several, all charts
 * of every station. The tiles show the measures so far.
 * @param {HTMLElement} host @param {View} view @param {any} plan @param {{measures: import("./measures.js").Measure[], channels: Record<string, any>}} declared
 */
export function buildCharts(host, view, plan, declared) {
  const tiles = new Tiles(plan, declared.measures);
  const kind = /** @type {keyof typeof SIGNALS} */ (plan.test);
  const several = plan.stations.length > 1;
  const names = SIGNALS[kind].filter((name) => several || !FIRST[kind].includes(name));
  const sections = plan.stations.map((/** @type {any} */ station, /** @type {number} */ i) => {
    const strips = stationStrips(view.store, plan, i, names, declared.channels);
    const loops = [...(several ? [loop(view, plan, i)] : []), ...(kind === "specimen" ? [] : [subspace(view, plan, i)])];
    const title = several ? `${HEAD[kind]} ${i + 1}: ${station.name}` : `${HEAD[kind]}: ${station.name}`;
    return section(title, tiles.stations[i].element, [...loops, ...strips.map((strip) => chart(view, strip))]);
  });
  const hybrid = plan.test === "hybrid";
  const structure = plan.structure.kind === "none" ? null : section("Structure", tiles.structure.element, hybrid ? floorStrips(view.store).map((strip) => chart(view, strip)) : []);
  const inputs = hybrid ? inputStrips(view.store, plan).map((strip) => chart(view, strip)) : [];
  host.replaceChildren(...sections, ...[structure, inputs.length ? section("Excitation", null, inputs) : null].filter((one) => one !== null));
  return tiles;
}

/** @param {View} view @param {Strip} strip */
const chart = (view, { title, unit, series, limit }) => new TimeChart(view, title, unit, series, { limit });

/** @param {View} view @param {any} plan @param {number} station */
function loop(view, plan, station) {
  const [x, y] = pair(view.store, plan, station, ["x_meas", "displacement"], ["f_meas", "force"]);
  return new LoopChart(view, "Force against displacement", x, y);
}

/** @param {View} view @param {any} plan @param {number} station */
function subspace(view, plan, station) {
  const [x, y] = pair(view.store, plan, station, ["x_cmd", "command"], ["x_meas", "measured"]);
  return new LoopChart(view, "Synchronisation subspace", x, y, true);
}

/** @param {string} title @param {HTMLElement | null} tiles @param {{figure: {element: HTMLElement}}[]} charts */
function section(title, tiles, charts) {
  return el("section", {}, el("h2", {}, title), tiles, el("div", { class: "charts" }, ...charts.map((one) => one.figure.element)));
}
