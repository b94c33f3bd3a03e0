// @ts-check
import { colour } from "../dom.js";
import { fixed } from "../format.js";

/** @typedef {{axes: {label: string, present: number, values: number[]}[], radius: number[][]}} StabilityMap */

const LIMIT = 1;
// from well damped to fast growing; the middle, white or black, is the limit
const COLOURS = ["#2166ac", "#92c5de", "#f7f7f7", "#f4a582", "#b2182b"];

/** @param {StabilityMap} map @param {{radius: number, stable: boolean}} found */
export function mapWords(map, found) {
  const all = map.radius.flat();
  const unstable = all.filter((radius) => radius > LIMIT + 1e-9).length;
  const [first, second] = map.axes;
  return (
    `The line is the limit, a spectral radius of 1; ${Math.round((100 * unstable) / all.length)} % of the map is unstable. ` +
    `The cross is this plan: ${first.label} ${fixed(first.present, 1)}, ${second.label} ${fixed(second.present, 1)}, ` +
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
    colorbar: { title: { text: "Radius" }, thickness: 12, tickformat: ".3f" },
  };
  const axis = (/** @type {string} */ title) => ({ title: { text: title }, gridcolor: grid, zerolinecolor: grid });
  const surface = kind === "surface";
  const drawn = surface ? [surfaceOf(shown, away), present3d(first, second, radius, text)] : contourOf(shown, away, first, second, text);
  const layout = {
    font: { family: "system-ui, sans-serif", size: 12, color: text },
    paper_bgcolor: "rgba(0,0,0,0)",
    plot_bgcolor: "rgba(0,0,0,0)",
    margin: { l: 60, r: 10, t: 15, b: 50 },
    showlegend: false,
    ...(surface
      ? { scene: { xaxis: axis(first.label), yaxis: axis(second.label), zaxis: axis("Radius") } }
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
  contours: { z: { show: true, start: LIMIT, end: LIMIT, size: 1, color: "#000", width: 4 } },
  hovertemplate: "%{x:.1f}, %{y:.1f}: radius %{z:.5f}<extra></extra>",
});

/** @param {any} first @param {any} second @param {number} radius @param {string} text */
const present3d = (first, second, radius, text) => ({
  type: "scatter3d",
  mode: "markers",
  x: [first.present],
  y: [second.present],
  z: [radius],
  marker: { symbol: "cross", size: 6, color: text },
  hovertemplate: "this plan: radius %{z:.5f}<extra></extra>",
});

/** @param {any} shown @param {number} away @param {any} first @param {any} second @param {string} text */
const contourOf = (shown, away, first, second, text) => [
  {
    ...shown,
    type: "heatmap",
    zsmooth: "best",
    zmin: LIMIT - away,
    zmax: LIMIT + away,
    hovertemplate: "%{x:.1f}, %{y:.1f}: radius %{z:.5f}<extra></extra>",
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
    marker: { symbol: "x-thin", size: 14, line: { width: 3, color: "#111" }, color: text },
    hovertemplate: "this plan<extra></extra>",
  },
];

/** @returns {any} the global of the classic script */
const plotly = () => /** @type {any} */ (window).Plotly;
