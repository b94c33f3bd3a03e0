// @ts-check
import { el } from "../dom.js";
import { rateSays } from "../files/rate.js";
import { labelled } from "../form/field.js";
import { numeric } from "./column_row.js";

/** Sampling rate (Hz) of a number in each unit. @type {Record<string, (value: number) => number>} */
const RATES = { Hz: (value) => value, s: (value) => 1 / value, ms: (value) => 1e3 / value };
const KINDS = { "": "not given", hybrid: "hybrid", specimen: "specimen alone", actuator: "actuator alone", structure: "structure alone" };

/** The settings of a mapping besides its columns: name, kind of test, sampling rates, and the part of the file to import. */
export class MappingSettings {
  samples = 0;
  asked = false;

  constructor() {
    const text = (/** @type {string} */ mode) => el("input", { type: "text", inputmode: mode, autocomplete: "off" });
    this.controls = {
      title: text("text"),
      test: el("select", {}, ...Object.entries(KINDS).map(([value, words]) => el("option", { value }, words))),
      rate: text("decimal"),
      rateUnit: el("select", { "aria-label": "Unit of the rate or step" }, ...Object.keys(RATES).map((unit) => el("option", { value: unit }, unit))),
      start: text("decimal"),
      stop: text("decimal"),
      target_rate: text("decimal"),
    };
    const { title, test, rate, rateUnit, start, stop, target_rate } = this.controls;
    title.maxLength = 200;
    const sampling = labelled("mapping.rate", "Sampling rate or step of the file", rate, "needed only if no column is time");
    const both = el("div", { class: "measure" });
    rate.replaceWith(both);
    both.append(rate, rateUnit);
    this.result = sampling.querySelector(".hint");
    for (const control of [rate, rateUnit]) control.addEventListener("input", () => this.#tellRate());
    this.element = el(
      "div",
      { class: "fields" },
      labelled("mapping.title", "Name of the recording", title),
      labelled("mapping.test", "Kind of test", test),
      sampling,
      labelled("mapping.start", "Start", start, "in the file's time", "s"),
      labelled("mapping.stop", "Stop", stop, "in the file's time", "s"),
      labelled("mapping.target_rate", "Sampling rate of the recording", target_rate, "empty: the highest rate of the channels", "Hz"),
    );
  }

  /** @param {any} mapping @param {string} name */
  fill({ title, test, dt, rate, start, stop, target_rate }, name) {
    const values = { title: title || name, test: test ?? "", rate: rate ?? dt, rateUnit: dt && !rate ? "s" : "Hz", start, stop, target_rate };
    for (const [key, control] of Object.entries(this.controls)) control.value = values[/** @type {keyof typeof values} */ (key)] ?? "";
    this.#tellRate();
  }

  read() {
    const { title, test, rate, rateUnit, start, stop, target_rate } = this.controls;
    const given = numeric(rate.value);
    const step = rateUnit.value === "ms" && typeof given === "number" ? Number((given / 1e3).toPrecision(15)) : given;
    return {
      title: title.value.trim(),
      test: test.value || null,
      rate: rateUnit.value === "Hz" ? given : null,
      dt: rateUnit.value === "Hz" ? null : step,
      start: numeric(start.value),
      stop: numeric(stop.value),
      target_rate: numeric(target_rate.value),
    };
  }

  /** Ask for the rate or step where neither a column nor the file states it. @param {boolean} asked @param {number} samples of the file */
  ask(asked, samples) {
    this.samples = samples;
    this.asked = asked;
    this.controls.rate.classList.toggle("asked", asked && !this.controls.rate.value.trim());
    this.#tellRate();
  }

  /** What the rate means for the file, so that a wrong unit is seen. */
  #tellRate() {
    const { rate, rateUnit } = this.controls;
    const value = numeric(rate.value);
    const hertz = typeof value === "number" && value > 0 ? RATES[rateUnit.value](value) : 0;
    const empty = this.asked ? "the file does not state it: give the rate, or the step" : "needed only if no column is time";
    this.result.textContent = hertz ? rateSays(hertz, this.samples) : empty;
  }

  /** Show a problem beside its field. Returns whether the problem has a field. @param {string} where @param {string} text */
  tell(where, text) {
    const name = where.replace("mapping.dt", "mapping.rate").match(/^mapping\.(title|test|rate|start|stop|target_rate)\b/)?.[1];
    const place = name && this.element.querySelector(`[id="e-mapping.${name}"]`);
    if (place) place.textContent = text;
    return Boolean(place);
  }

  clear() {
    for (const place of this.element.querySelectorAll("small.error")) place.textContent = "";
  }
}
