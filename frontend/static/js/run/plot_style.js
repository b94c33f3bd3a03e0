// @ts-check
import { colour } from "../dom.js";

/** @type {Map<string, string>} */
const resolved = new Map();
document.addEventListener("themechange", () => resolved.clear());

/** A theme colour for the canvas, looked up once a theme. @param {string} name */
export function themed(name) {
  let found = resolved.get(name);
  if (!found) resolved.set(name, (found = colour(name)));
  return found;
}

const FONT = "11px system-ui, sans-serif";

/** @param {string} [label] @param {number} [size] */
export function axis(label, size) {
  return {
    label,
    size,
    font: FONT,
    labelFont: FONT,
    labelSize: 16,
    gap: 3,
    space: label ? 50 : 24,
    stroke: () => themed("--pico-muted-color"),
    grid: { stroke: () => themed("--grid"), width: 1 },
    ticks: { stroke: () => themed("--grid"), width: 1, size: 4 },
  };
}

/** A range around the data that is never empty. @param {number} low @param {number} high @returns {[number, number]} */
export function padded(low, high) {
  if (!(high >= low)) return [-1, 1];
  const pad = Math.max((high - low) * 0.06, Math.abs(high) * 1e-3) || 1;
  return [low - pad, high + pad];
}

/** Keep a plot as large as its box. @param {HTMLElement} box @param {(width: number, height: number) => void} resize */
export function fit(box, resize) {
  new ResizeObserver(() => {
    if (box.clientWidth && box.clientHeight) resize(box.clientWidth, box.clientHeight);
  }).observe(box);
}
