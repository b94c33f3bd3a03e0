// @ts-check
import { colour } from "../dom.js";
import { fixed } from "../format.js";

/** @typedef {{axes: {station: number, label: string, present: number, values: number[]}[], radius: number[][]}} StabilityMap */

const LIMIT = 1;
// view from the corner without delay, on the stable side
const VIEW = { camera: { eye: { x: -1.5, y: -1.7, z: 1.1 } }, aspectmode: "manual", aspectratio: { x: 1.2, y: 1.2, z: 0.7 } };
// from well damped to fast growing; the middle colour is the limit
const COLOURS = ["#2166ac", "#92c5de", "#f7f7f7", "#f4a582", "#b2182b"];

/** @param {StabilityMap} map @param {{radius: number, stable: boolean}} found */
export function mapWords(map, found) {
  const all = map.radius.flat();
  const unstable = all.filter((radius) => radius > LIMIT + 1e-9).length;
  const [first, second] = map.axes;
  return (
    `The line marks the stability limit, a spectral radius of 1. ${Math.round((100 * unstable) / all.length)} % of the map is unstable. ` +
    `The mark shows this plan: ${first.label} ${fixed(first.present, 1)}, ${second.label} ${fixed(second.present, 1)}, ` +
    `${found.stable ? "stable" : "unstable"}.`
  );
}

/** @param {HTMLElement} box @param {StabilityMap} map @param {number} radius @param {string} kind */
export function drawMap(box, map, radius, kind) {
  const [first, second] = map.axes;
  const text = colour("--pico-color");
  const grid = colour("--grid");
  const away = Math.max(1e-4, ...map.radius.flat().map((one) => Math.abs(one - LIMIT)));
  const shown = {
    x: first.values,
    y: second.values,
    z: map.radius,
    colorscale: COLOURS.map((one, i) => [i / (COLOURS.length - 1), one]),
    colorbar: { title: { text: "Spectral radius" }, thickness: 12, tickformat: ".3f" },
  };
  const axis = (/** @type {string} */ title) => ({ title: { text: title }, gridcolor: grid, zerolinecolor: grid, automargin: true });
  const axis3d = (/** @type {string} */ title) => ({ title: { text: title }, gridcolor: grid, zerolinecolor: grid });
  const surface = kind === "surface";
  const drawn = surface ? [surfaceOf(shown, away), present3d(first, second, radius + 0.04 * span(map))] : contourOf(shown, away, first, second);
  const layout = {
    font: { family: "system-ui, sans-serif", size: 12, color: text },
    paper_bgcolor: "rgba(0,0,0,0)",
    plot_bgcolor: "rgba(0,0,0,0)",
    margin: surface ? { l: 0, r: 0, t: 0, b: 0 } : { l: 60, r: 10, t: 15, b: 60 },
    showlegend: false,
    ...(surface
      ? { scene: { ...VIEW, xaxis: axis3d(`Station ${first.station}`), yaxis: axis3d(`Station ${second.station}`), zaxis: axis3d("Spectral radius") } }
      : { xaxis: axis(first.label), yaxis: axis(second.label) }),
  };
  plotly().react(box, drawn, layout, { responsive: true, displaylogo: false });
}

/** @param {any} shown @param {number} away */
const surfaceOf = (shown, away) => ({
  ...shown,
  type: "surface",
  cmin: LIMIT - away,
  cmax: LIMIT + away,
  contours: { z: { show: true, start: LIMIT, end: LIMIT + 1e-6, size: 1, color: "#000", width: 4 } },
  hovertemplate: "%{x:.1f}, %{y:.1f}: spectral radius %{z:.5f}<extra></extra>",
});

/** @param {StabilityMap} map */
const span = (map) => Math.max(...map.radius.flat()) - Math.min(...map.radius.flat());

/** The mark of this plan, a little above the surface so that it is visible. @param {any} first @param {any} second @param {number} height */
const present3d = (first, second, height) => ({
  type: "scatter3d",
  mode: "markers",
  x: [first.present],
  y: [second.present],
  z: [height],
  marker: { symbol: "diamond", size: 6, color: "#111" },
  hovertemplate: "this plan<extra></extra>",
});

/** @param {any} shown @param {number} away @param {any} first @param {any} second */
const contourOf = (shown, away, first, second) => [
  {
    ...shown,
    type: "heatmap",
    zsmooth: "best",
    zmin: LIMIT - away,
    zmax: LIMIT + away,
    hovertemplate: "%{x:.1f}, %{y:.1f}: spectral radius %{z:.5f}<extra></extra>",
  },
  {
    x: shown.x,
    y: shown.y,
    z: shown.z,
    type: "contour",
    hoverinfo: "skip",
    showscale: false,
    contours: { type: "constraint", operation: "=", value: LIMIT },
    line: { color: "#111", width: 2.5 },
  },
  {
    type: "scatter",
    mode: "markers",
    x: [first.present],
    y: [second.present],
    marker: { symbol: "x-thin", size: 14, line: { width: 3, color: "#111" } },
    hovertemplate: "this plan<extra></extra>",
  },
];

/** @returns {any} the global of the classic script */
const plotly = () => /** @type {any} */ (window).Plotly;
