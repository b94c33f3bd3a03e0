// @ts-check
import uPlot from "/static/vendor/uplot/uPlot.esm.js";
import { el } from "../dom.js";
import { samplePlot } from "../files/sample_plot.js";
import { number, significant } from "../format.js";
import { loopPath } from "../run/loop_path.js";
import { axis, fit, padded, themed } from "../run/plot_style.js";
import { meanOf } from "./column_facts.js";

/**
 * @typedef {{key: string, role: string, label: string, unit: string, column: string, smallest: number, largest: number, mean: number, moved: string, samples: number, time: number[], values: number[]}} Channel
 * @typedef {{station: number, x: number[], y: number[], x_unit: string, y_unit: string}} Loop
 * @typedef {{channels: Channel[], loops: Loop[], samples: number | null, dt_s: number, start_s: number}} Preview
 */

const MOST = 24; // most plots shown
const COLOURS = /** @type {Record<string, string>} */ ({ x: "--line-1", v: "--line-3", f: "--line-2" });

/**
 * Plots of a recording's channels and of force against displacement. `part` asks the service for a part of the time.
 * @param {Preview} preview @param {(from: number, to: number) => Promise<Preview>} part @returns {HTMLElement}
 */
export function plotsOf({ channels, loops }, part) {
  const shown = channels.slice(0, MOST);
  const rest = channels.length - shown.length;
  return el(
    "div",
    { class: "preview" },
    el("div", { class: "charts" }, ...loops.map(loopFigure), ...shown.map((channel) => plot(channel, part))),
    rest > 0 && el("p", { class: "muted" }, `${rest} more channels are imported but not plotted.`),
  );
}

/** Number of samples, rate and duration. @param {Preview} preview */
export function factsLine({ samples, dt_s, start_s }) {
  const from = start_s ? `, from ${number(start_s)} s of the file` : "";
  return `${samples} samples at ${significant(1 / dt_s, 6)} Hz, ${significant((Number(samples) - 1) * dt_s, 6)} s${from}`;
}

/** @param {Channel} channel @param {(from: number, to: number) => Promise<Preview>} part */
function plot({ key, role, label, unit, smallest, largest, mean, samples, time, values }, part) {
  const said = `${number(smallest)} to ${number(largest)} ${unit}, mean ${meanOf({ smallest, largest, mean })} ${unit}`;
  const inside = async (/** @type {number} */ from, /** @type {number} */ to) => {
    const found = (await part(from, to)).channels.find((one) => one.key === key);
    return { x: found?.time ?? [], y: found?.values ?? [], samples: found?.samples };
  };
  const named = { title: `${label}, ${unit}`, said, xLabel: "Time, s", xUnit: "s", yUnit: unit, line: COLOURS[role[0]] ?? "--line-4" };
  return samplePlot({ ...named, x: time, y: values, samples, part: samples > time.length ? inside : undefined });
}

/** @param {Loop} loop */
function loopFigure({ station, x, y, x_unit, y_unit }) {
  const title = `Force against displacement, station ${station}, ${y_unit} and ${x_unit}`;
  const box = el("div", { class: "plot", role: "img", tabindex: "0", "aria-label": title });
  /** @type {any} */
  let drawn = null;
  const range = (/** @type {number[]} */ values) => padded(Math.min(...values), Math.max(...values));
  fit(box, (width, height) => {
    if (drawn) return drawn.setSize({ width, height });
    const facets = [{ scale: "x", auto: true }, { scale: "y", auto: true }];
    drawn = new uPlot(
      {
        mode: 2,
        width,
        height,
        legend: { show: false },
        cursor: { show: false },
        scales: { x: { time: false, range: () => range(x) }, y: { range: () => range(y) } },
        axes: [axis(`Displacement, ${x_unit}`, 34), axis(undefined, 52)],
        series: /** @type {any[]} */ ([null, { stroke: () => themed("--line-2"), width: 1, facets, paths: loopPath }]),
      },
      /** @type {any} */ ([null, [x, y]]),
      box,
    );
    const follow = () => (box.isConnected ? drawn.redraw(false) : document.removeEventListener("themechange", follow));
    document.addEventListener("themechange", follow);
  });
  return el("figure", { class: "chart square" }, el("figcaption", {}, el("strong", {}, title)), box);
}
