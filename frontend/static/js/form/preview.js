// @ts-check
import { el } from "../dom.js";
import { samplePlot } from "../files/sample_plot.js";
import { number, significant } from "../format.js";

/**
 * The preview of a record from the service: its samples and its response spectrum with `damping`, in SI units.
 * @typedef {{name: string, title: string, dt: number, duration: number, samples: number, pga: number, provenance: string,
 *   time: number[], acceleration: number[], spectrum: {periods: number[], sa: number[], damping: number}}} Preview
 */

const GRAVITY = 9.80665;

/** Plots of a record's acceleration and response spectrum, below its key figures. @param {Preview} preview @returns {HTMLElement} */
export function previewOf(preview) {
  const { spectrum } = preview;
  const inG = (/** @type {number[]} */ values) => values.map((value) => value / GRAVITY);
  const sa = inG(spectrum.sa);
  const peak = sa.indexOf(Math.max(...sa));
  const facts = `${preview.title || preview.name}: PGA ${significant(preview.pga / GRAVITY)} g, ${number(preview.duration, 4)} s in steps of ${significant(preview.dt, 6)} s`;
  const damping = `${number(100 * spectrum.damping, 2)} % damping`;
  return el(
    "div",
    { class: "preview" },
    el("p", { class: "facts-line" }, facts),
    el(
      "div",
      { class: "charts" },
      samplePlot({
        title: "Ground acceleration, g",
        said: `from ${facts}`,
        xLabel: "Time, s",
        xUnit: "s",
        yUnit: "g",
        x: preview.time,
        y: inG(preview.acceleration),
        samples: preview.samples,
        line: "--line-1",
      }),
      samplePlot({
        title: `Response spectrum Sa, g (${damping})`,
        said: `largest ${significant(sa[peak])} g at a period of ${number(spectrum.periods[peak], 3)} s`,
        xLabel: "Period, s",
        xUnit: "s",
        yUnit: "g",
        x: spectrum.periods,
        y: sa,
        line: "--line-2",
        of: "periods",
      }),
    ),
    preview.provenance && el("p", { class: "muted provenance" }, preview.provenance),
  );
}
