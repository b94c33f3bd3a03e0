// @ts-check
import { api } from "../api.js";
import { byId, colour, el } from "../dom.js";
import { plot, title } from "./plotting.js";
import { digits, titled } from "./results.js";

/** @typedef {import("./results.js").Results} Results */

/** The probability that the measure exceeds a level, against an intensity. */
export class Fragility {
  measure = "";

  /** @param {string} sweep @param {Results} results @param {(error: unknown) => void} complain */
  constructor(sweep, results, complain) {
    this.sweep = sweep;
    this.results = results;
    for (const id of ["level", "intensity", "tripped"]) byId(id).addEventListener("change", () => this.draw(this.measure).catch(complain));
  }

  /** Offer the intensities, and the median of the measure as level. @param {string} measure */
  #offer(measure) {
    const { results } = this;
    const box = byId("intensity");
    const kept = box.value;
    const loads = /^(motion|drive|forces)\b/; // inputs that say how strongly a test is shaken
    const some = results.numbers("intensity", "input").filter(({ key, role }) => role === "intensity" || loads.test(key));
    const varied = some.filter(({ key }) => new Set(results.values[key]).size > 1);
    const order = [...varied].sort((a, b) => Number(b.role === "intensity") - Number(a.role === "intensity"));
    box.replaceChildren(...order.map((one) => el("option", { value: one.key }, titled(one))));
    if (order.some(({ key }) => key === kept)) box.value = kept;
    else box.value = order.find(({ key }) => key === "sa_t1_g")?.key ?? order[0]?.key ?? "";
    if (measure !== this.measure || byId("level").value === "") {
      const sorted = results.values[measure].filter((one) => typeof one === "number").map(Math.abs).sort((a, b) => a - b);
      byId("level").value = sorted.length ? digits(sorted[Math.floor(sorted.length / 2)]) : "";
    }
    byId("level-unit").textContent = results.column(measure).shown_label;
    return order.length;
  }

  /** @param {string} measure */
  async draw(measure) {
    const offered = this.#offer(measure);
    this.measure = measure;
    const column = this.results.column(measure);
    const level = Number(byId("level").value.replace(",", ".").replace("−", "-"));
    byId("fragility-title").textContent = `Fragility: ${titled(column)} above ${byId("level").value}`;
    const words = byId("fragility-words");
    const box = byId("fragility");
    if (!offered || !Number.isFinite(level) || byId("level").value === "") {
      words.textContent = offered ? "Give the level as a number." : "No intensity varies among the points. Give the sweep several records or scales.";
      return plot(box, [], {});
    }
    const intensity = this.results.column(byId("intensity").value);
    const query = new URLSearchParams({ measure, level: String(level), intensity: intensity.key, tripped: String(byId("tripped").checked) });
    const found = await api.get(`/sweeps/${this.sweep}/fragility?${query}`);
    const unit = intensity.shown_label;
    const fitted = found.median === null ? found.reason : `Fitted lognormal curve: median ${`${digits(found.median)} ${unit}`.trim()}, dispersion ${digits(found.dispersion)}.`;
    const trips = found.tripped ? ` ${found.tripped} of them tripped.` : "";
    words.textContent = `${found.exceeding} of ${found.points} points exceed the level.${trips} ${fitted}`;
    const curve = { type: "scatter", mode: "lines", x: found.intensities, y: found.probabilities, line: { color: colour("--curve-1"), width: 2 }, name: "fitted", hovertemplate: "%{x:.3g}: %{y:.3f}<extra>fitted</extra>" };
    const points = {
      type: "scatter",
      mode: "markers",
      x: found.empirical.map((/** @type {any} */ one) => one.intensity),
      y: found.empirical.map((/** @type {any} */ one) => one.exceeding / one.points),
      text: found.empirical.map((/** @type {any} */ one) => `${one.exceeding} of ${one.points} points`),
      marker: { color: colour("--curve-2"), size: 8 },
      name: "points",
      hovertemplate: "%{text} at %{x:.3g}<extra></extra>",
    };
    plot(box, [curve, points], { hovermode: "closest", xaxis: { ...title(titled(intensity)), rangemode: "tozero" }, yaxis: { ...title("Probability"), range: [-0.03, 1.03] } });
  }
}
