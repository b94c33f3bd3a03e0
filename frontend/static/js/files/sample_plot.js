// @ts-check
import uPlot from "/static/vendor/uplot/uPlot.esm.js";
import { el } from "../dom.js";
import { significant } from "../format.js";
import { axis, fit, padded, themed } from "../run/plot_style.js";

/**
 * A signal to plot. `of` names its points, by default samples. `samples`: how many it has where only the extremes of equal parts are given. `part` asks for the samples
 * between two places on the x axis.
 * @typedef {{x: number[], y: number[], samples?: number}} Samples
 * @typedef {Samples & {title: string, said: string, xLabel: string, xUnit: string, yUnit: string, line: string,
 *   of?: string, part?: (from: number, to: number) => Promise<Samples>}} Signal
 */

const SPACED = 8; // pixels between samples from which each is drawn as a point
const FACTOR = 4; // of a zoom by the keyboard

/** A plot whose cursor stands on samples: by the mouse, or by the slider below it, which has the keys of a slider and + and − to zoom. @param {Signal} signal @returns {HTMLElement} */
export function samplePlot(signal) {
  const { title, said, xLabel, line, of = "samples", part } = signal;
  const box = el("div", { class: "plot", role: "img", "aria-label": `${title}: ${said}` });
  const value = el("output", { class: "at muted", "aria-live": "off" });
  const slider = el("input", { type: "range", class: "samples", min: 0, step: 1, value: 0, "aria-label": `Sample of ${title}` });
  let { x, y, samples } = signal;
  let asked = 0;
  let held = x[0]; // where the cursor stood before the samples were replaced
  /** @type {any} */
  let plot = null;

  const counted = () => (samples && samples > x.length ? `${x.length} of ${samples} ${of}: the extremes` : `${x.length} ${of}`);
  const read = (/** @type {number | null | undefined} */ at) => {
    value.textContent = at == null ? counted() : reading(signal, x[at], y[at]);
    if (at == null) return;
    slider.value = String(at);
    slider.setAttribute("aria-valuetext", value.textContent ?? "");
  };
  const place = (/** @type {number} */ at) => plot?.setCursor({ left: plot.valToPos(x[at], "x"), top: plot.valToPos(y[at], "y") });
  const put = (/** @type {Samples} */ given) => {
    held = x[Number(slider.value)];
    ({ x, y, samples } = given);
    slider.max = String(Math.max(0, x.length - 1));
    plot?.setData([x, y]);
    read(null);
  };
  const show = async (/** @type {number} */ from, /** @type {number} */ to) => {
    const mine = ++asked;
    const inside = part ? await part(from, to) : within(signal, from, to);
    const shown = mine === asked && inside.x.length > 1;
    if (shown) put(inside);
    return shown;
  };
  const reset = () => {
    asked++;
    put(signal);
  };
  slider.addEventListener("input", () => place(Number(slider.value)));
  slider.addEventListener("keydown", async (/** @type {KeyboardEvent} */ event) => {
    const closer = event.key === "+" || event.key === "=";
    if (!closer && event.key !== "-" && event.key !== "Escape") return;
    event.preventDefault();
    const middle = x[Number(slider.value)];
    const half = (x[x.length - 1] - x[0]) / (2 * FACTOR);
    if (!closer) reset();
    else if (!(await show(middle - half, middle + half))) return;
    place(nearest(x, held));
  });

  fit(box, (width, height) => {
    if (plot) return plot.setSize({ width, height });
    plot = new uPlot(
      {
        width,
        height,
        legend: { show: false },
        scales: { x: { time: false }, y: { range: (/** @type {any} */ _, /** @type {number} */ low, /** @type {number} */ high) => padded(low, high) } },
        axes: [axis(xLabel, 34), axis(undefined, 52)],
        series: [
          {},
          {
            stroke: () => themed(line),
            width: 1,
            points: { size: 4, fill: () => themed(line), show: (/** @type {any} */ u, /** @type {number} */ _, /** @type {number} */ first, /** @type {number} */ last) => u.bbox.width / devicePixelRatio > SPACED * (last - first) },
          },
        ],
        cursor: { y: false, points: { size: 8, fill: () => themed(line) }, drag: { x: true, y: false, setScale: false }, bind: { dblclick: () => () => (reset(), null) } },
        hooks: {
          setCursor: [(/** @type {any} */ u) => read(u.cursor.left < 0 ? null : u.cursor.idx)],
          setSelect: [
            (/** @type {any} */ u) => {
              const { left, width: wide } = u.select;
              if (wide < 3) return;
              u.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
              show(u.posToVal(left, "x"), u.posToVal(left + wide, "x"));
            },
          ],
        },
      },
      [x, y],
      box,
    );
    const follow = () => (box.isConnected ? plot.redraw(false) : document.removeEventListener("themechange", follow));
    document.addEventListener("themechange", follow);
  });
  put(signal);
  return el("figure", { class: "chart samples-of" }, el("figcaption", {}, el("strong", {}, title), value), box, slider);
}

/** @param {Signal} signal @param {number} x @param {number} y */
const reading = ({ xUnit, yUnit }, x, y) => `${significant(y, 6)} ${yUnit} at ${significant(x, 9)} ${xUnit}`;

/** @param {Samples} all @param {number} from @param {number} to @returns {Samples} */
function within({ x, y }, from, to) {
  const inside = x.map((_, at) => at).filter((at) => x[at] >= from && x[at] <= to);
  return { x: inside.map((at) => x[at]), y: inside.map((at) => y[at]) };
}

/** @param {number[]} x @param {number} wanted */
const nearest = (x, wanted) => x.reduce((best, one, at) => (Math.abs(one - wanted) < Math.abs(x[best] - wanted) ? at : best), 0);
