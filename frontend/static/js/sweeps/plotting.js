// @ts-check
import { colour } from "../dom.js";

const CONFIG = { displayModeBar: false, responsive: true };
// light to dark in one hue, so that the order of the colours is the order of the values
export const SCALE = ["--heat-0", "--heat-1", "--heat-2", "--heat-3"];

/** The colour scale of the theme, as Plotly reads it. @returns {[number, string][]} */
export const colourScale = () => SCALE.map((name, i) => [i / (SCALE.length - 1), colour(name)]);

/** The colour of a share from 0 to 1. @param {number} share */
export function shaded(share) {
  const stops = SCALE.map((name) => (colour(name).match(/[\d.]+/g) ?? []).slice(0, 3).map(Number));
  const at = Math.min(Math.max(share, 0), 1) * (stops.length - 1);
  const k = Math.min(Math.floor(at), stops.length - 2);
  return `rgb(${stops[k].map((one, i) => Math.round(one + (stops[k + 1][i] - one) * (at - k))).join(",")})`;
}

/** Draw a plot in the theme of the page. @param {any} box @param {object[]} traces @param {any} layout @param {(point: any) => void} [clicked] */
export function plot(box, traces, layout, clicked) {
  const [text, grid] = [colour("--pico-muted-color"), colour("--grid")];
  const axis = (/** @type {any} */ more) => ({ gridcolor: grid, zerolinecolor: grid, linecolor: grid, automargin: true, ...more });
  const { xaxis = {}, yaxis = {}, ...rest } = layout;
  const whole = {
    font: { family: "system-ui, sans-serif", size: 12, color: text },
    paper_bgcolor: "rgba(0,0,0,0)",
    plot_bgcolor: "rgba(0,0,0,0)",
    margin: { l: 60, r: 12, t: 10, b: 48 },
    showlegend: false,
    dragmode: false,
    ...rest,
    xaxis: axis(xaxis),
    yaxis: axis(yaxis),
  };
  /** @type {any} */ (window).Plotly.react(box, traces, whole, CONFIG);
  box.removeAllListeners?.("plotly_click");
  if (clicked) box.on("plotly_click", (/** @type {any} */ event) => clicked(event.points[0]));
}

/** A title of an axis. @param {string} text */
export const title = (text) => ({ title: { text, standoff: 6 } });
