// @ts-check
import uPlot from "/static/vendor/uplot/uPlot.esm.js";
import { el } from "../dom.js";
import { number } from "../format.js";
import { axis, fit, padded, themed } from "../run/plot_style.js";

/**
 * The preview of a record from the service: its samples and its response spectrum with `damping`, in SI units.
 * @typedef {{name: string, title: string, dt: number, duration: number, pga: number, provenance: string,
 *   time: number[], acceleration: number[], spectrum: {periods: number[], sa: number[], damping: number}}} Preview
 */

const GRAVITY = 9.80665;

/** Plots of a record's acceleration and response spectrum, below its key figures. @param {Preview} preview @returns {HTMLElement} */
export function previewOf(preview) {
  const { spectrum } = preview;
  const inG = (/** @type {number[]} */ values) => values.map((value) => value / GRAVITY);
  const sa = inG(spectrum.sa);
  const peak = sa.indexOf(Math.max(...sa));
  const facts = `${preview.title || preview.name}: PGA ${number(preview.pga / GRAVITY, 3)} g, ${number(preview.duration, 4)} s in steps of ${number(preview.dt, 3)} s`;
  const damping = `${number(100 * spectrum.damping, 2)} % damping`;
  return el(
    "div",
    { class: "preview" },
    el("p", { class: "facts-line" }, facts),
    el(
      "div",
      { class: "charts" },
      chart("Ground acceleration, g", `from ${facts}`, "Time, s", preview.time, inG(preview.acceleration), "--line-1"),
      chart(
        `Response spectrum Sa, g (${damping})`,
        `largest ${number(sa[peak], 3)} g at a period of ${number(spectrum.periods[peak], 3)} s`,
        "Period, s",
        spectrum.periods,
        sa,
        "--line-2",
      ),
    ),
    preview.provenance && el("p", { class: "muted provenance" }, preview.provenance),
  );
}

/** @param {string} title @param {string} said @param {string} xLabel @param {number[]} x @param {number[]} y @param {string} line */
export function chart(title, said, xLabel, x, y, line) {
  const box = el("div", { class: "plot", role: "img", tabindex: "0", "aria-label": `${title}: ${said}` });
  const value = el("output", { class: "at muted", "aria-live": "off" });
  /** @type {any} */
  let plot = null;
  fit(box, (width, height) => {
    if (plot) return plot.setSize({ width, height });
    plot = new uPlot(
      {
        width,
        height,
        legend: { show: false },
        scales: { x: { time: false }, y: { range: (/** @type {any} */ _, /** @type {number} */ low, /** @type {number} */ high) => padded(low, high) } },
        axes: [axis(xLabel, 34), axis(undefined, 52)],
        series: [{}, { stroke: () => themed(line), width: 1, points: { show: false } }],
        cursor: { y: false, points: { show: false } },
        hooks: {
          setCursor: [(/** @type {any} */ u) => (value.textContent = u.cursor.idx == null ? "" : `${number(y[u.cursor.idx])} at ${number(x[u.cursor.idx])} s`)],
        },
      },
      [x, y],
      box,
    );
    const follow = () => (box.isConnected ? plot.redraw(false) : document.removeEventListener("themechange", follow));
    document.addEventListener("themechange", follow);
  });
  return el("figure", { class: "chart" }, el("figcaption", {}, el("strong", {}, title), value), box);
}
