// @ts-check
import { el } from "../dom.js";
import { LoopChart } from "./loop_chart.js";
import { TimeChart } from "./time_chart.js";
import { View } from "./view.js";

/** @typedef {import("./store.js").Store} Store @typedef {import("./store.js").Channel} Channel */

const COLOURS = ["--line-1", "--line-2", "--line-3", "--line-4"];

const STATION_CHARTS = [
  { title: "Displacement", keys: ["x_cmd", "x_meas"], labels: ["command", "measured"] },
  { title: "Tracking error", keys: ["error"], labels: [""] },
  { title: "Tracking indicator TI", keys: ["ti"], labels: [""] },
  { title: "Adaptation Δα", keys: ["d_alpha"], labels: [""] },
  { title: "Energy error", keys: ["energy_error"], labels: [""] },
];

/** Build the charts of all groups into `host` and return the view that draws them. @param {HTMLElement} host @param {Store} store @param {string[]} stations */
export function buildCharts(host, store, stations) {
  const view = new View(store);
  const series = (/** @type {string} */ key, /** @type {string} */ label, /** @type {number} */ i) => {
    const index = store.index(key);
    return { index, label, unit: store.channels[index].unit, colour: COLOURS[i % COLOURS.length] };
  };
  const sections = stations.map((name, i) => {
    const group = `s${i + 1}`;
    const charts = STATION_CHARTS.map(({ title, keys, labels }) => {
      const lines = keys.map((key, j) => series(`${group}.${key}`, labels[j], j));
      if (lines.length > 1) Object.assign(lines[0], { width: 4, colour: "--line-wide" }); // seen behind the measured line
      return new TimeChart(view, title, lines[0].unit, lines);
    });
    const loop = new LoopChart(
      view,
      "Damper force against displacement",
      series(`${group}.x_meas`, "displacement", 0),
      series(`${group}.f_meas`, "force", 0),
    );
    return section(`Station ${i + 1}: ${name}`, [charts[0], loop, ...charts.slice(1)]);
  });
  host.replaceChildren(...sections, section("Structure", structureCharts(view, store, series)));
  return view;
}

/** @param {View} view @param {Store} store @param {(key: string, label: string, i: number) => any} series */
function structureCharts(view, store, series) {
  const charts = [];
  const floors = store.channels.filter((channel) => channel.group === "floors");
  if (floors.length) {
    const lines = floors.map((channel, i) => series(channel.key, `floor ${i + 1}`, i));
    charts.push(new TimeChart(view, "Floor displacement relative to the ground", lines[0].unit, lines));
  }
  if (store.index("ag") >= 0) {
    const line = series("ag", "", 0);
    charts.push(new TimeChart(view, "Ground acceleration", line.unit, [line]));
  }
  return charts;
}

/** @param {string} title @param {{figure: {element: HTMLElement}}[]} charts */
function section(title, charts) {
  return el("section", {}, el("h2", {}, title), el("div", { class: "charts" }, ...charts.map((chart) => chart.figure.element)));
}
