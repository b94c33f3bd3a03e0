// @ts-check
import { colour } from "../dom.js";

/** @type {Map<string, string>} */
const resolved = new Map();
document.addEventListener("themechange", () => resolved.clear());

/** A theme colour for the canvas, looked up once for each theme. @param {string} name */
export function themed(name) {
  let found = resolved.get(name);
  if (!found) resolved.set(name, (found = colour(name)));
  return found;
}

/** @param {string} [label] @param {number} [size] @param {number} [font] size of the font in pixels */
export function axis(label, size, font = 11) {
  const letters = `${font}px system-ui, sans-serif`;
  return {
    label,
    size,
    font: letters,
    labelFont: letters,
    labelSize: Math.max(16, 1.4 * font),
    gap: 3,
    space: label ? Math.max(50, 4.2 * font) : 24,
    values: (/** @type {any} */ _, /** @type {number[]} */ ticks) => tickLabels(ticks),
    stroke: () => themed("--pico-muted-color"),
    grid: { stroke: () => themed("--grid"), width: 1 },
    ticks: { stroke: () => themed("--grid"), width: 1, size: 4 },
  };
}

/** Labels of an axis with as many decimals as the distance of its ticks needs. @param {number[]} ticks */
export function tickLabels(ticks) {
  const step = ticks.length > 1 ? ticks[1] - ticks[0] : Math.abs(ticks[0] ?? 1) || 1;
  const size = Math.max(...ticks.map(Math.abs), 0);
  const decimals = Math.max(0, 1 - Math.floor(Math.log10(step)));
  if (step < 1e-3 || size >= 1e6) return ticks.map((tick) => (tick === 0 ? "0" : String(Number(tick.toPrecision(4)).toExponential())));
  return ticks.map((tick) => String(Number(tick.toFixed(decimals))));
}

/** Round places on an axis, about `count` of them. @param {[number, number]} range @param {number} count */
export function tickPlaces([low, high], count) {
  const rough = (high - low) / Math.max(2, count);
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = power * ([1, 2, 5].find((one) => one * power >= rough) ?? 10);
  const places = [];
  for (let k = Math.ceil(low / step); k * step <= high; k++) places.push(k * step);
  return places;
}

/** A range around the data that is never empty. @param {number} low @param {number} high @returns {[number, number]} */
export function padded(low, high) {
  if (!(high >= low)) return [-1, 1];
  const pad = Math.max((high - low) * 0.06, Math.abs(high) * 1e-3) || 1;
  return [low - pad, high + pad];
}

/** Resize a plot with its box. @param {HTMLElement} box @param {(width: number, height: number) => void} resize */
export function fit(box, resize) {
  new ResizeObserver(() => {
    if (box.clientWidth && box.clientHeight) resize(box.clientWidth, box.clientHeight);
  }).observe(box);
}
