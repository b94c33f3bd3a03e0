// @ts-check
import { ApiError, api, explain } from "../api.js";
import { el } from "../dom.js";
import { samplePlot } from "../files/sample_plot.js";
import { number } from "../format.js";
import { part } from "./parts.js";

/** @typedef {import("./field.js").Part} Part @typedef {import("./field.js").Node} Node @typedef {import("./schema.js").Schema} Schema */

const QUIET_MS = 300;
const MM = 1e-3;

/**
 * The fields of the drive with a live plot, and its peak displacement and velocity beside the station's limits.
 * @param {Schema} schema @param {Node} node @param {any} value @param {() => any} plan the whole plan as it stands @returns {Part}
 */
export function drivePart(schema, node, value, plan) {
  const fields = part(schema, node, "drive", value);
  const shown = el("div", { class: "preview", "aria-live": "off" });
  let timer = 0;
  let asked = 0;

  const show = async () => {
    if (!schema.applies(node)) return;
    const mine = ++asked;
    const { drive, controller_rate, duration, stations } = plan();
    if (drive.shape.kind === "still") return shown.replaceChildren();
    try {
      const preview = await api.post("/plans/drive", { drive, controller_rate, duration });
      if (mine === asked) shown.replaceChildren(...picture(preview, stations[0]?.limits ?? {}));
    } catch (error) {
      if (mine !== asked) return;
      const refused = error instanceof ApiError && error.errors.length; // the fields show these errors
      shown.replaceChildren(refused ? el("p", { class: "muted" }, "There is no plot because the drive has errors.") : el("p", { class: "error" }, explain(error)));
    }
  };
  const refresh = () => {
    clearTimeout(timer);
    timer = setTimeout(show, QUIET_MS);
  };
  refresh();
  const element = el("div", { "data-path": "drive" }, fields.element, shown);
  return { ...fields, element, refresh };
}

/** @param {{time: number[], displacement: number[], peak: number, velocity: number, duration: number}} preview @param {any} limits */
function picture({ time, displacement, peak, velocity, duration }, limits) {
  const beside = (/** @type {string} */ what, /** @type {number} */ reached, /** @type {any} */ limit, /** @type {string} */ unit) => {
    const bounded = typeof limit === "number";
    const text = `${what} ${number(reached / MM)} ${unit}${bounded ? ` (limit ${number(limit / MM)} ${unit})` : ""}`;
    return el("span", { class: bounded && reached > limit ? "beyond" : "" }, text);
  };
  const facts = el(
    "p",
    { class: "facts-line" },
    beside("Peak displacement", peak, limits.displacement, "mm"),
    ", ",
    beside("largest velocity", velocity, limits.velocity, "mm/s"),
    `, ${number(duration)} s`,
  );
  const said = `${number(peak / MM)} mm at most, ${number(duration)} s`;
  const plot = { title: "Prescribed displacement, mm", xLabel: "Time, s", xUnit: "s", yUnit: "mm", line: "--line-1" };
  return [facts, samplePlot({ ...plot, said, x: time, y: displacement.map((x) => x / MM) })];
}
