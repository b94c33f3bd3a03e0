// @ts-check
import { el } from "../dom.js";
import { labelled } from "../form/field.js";
import { numeric } from "./column_row.js";

const KINDS = { "": "not given", hybrid: "hybrid", specimen: "specimen alone", actuator: "actuator alone", structure: "structure alone" };

/** The settings of a mapping besides its columns: name, kind of test, sampling rates, and the part of the file to import. */
export class MappingSettings {
  constructor() {
    const text = (/** @type {string} */ mode) => el("input", { type: "text", inputmode: mode, autocomplete: "off" });
    this.controls = {
      title: text("text"),
      test: el("select", {}, ...Object.entries(KINDS).map(([value, words]) => el("option", { value }, words))),
      rate: text("decimal"),
      start: text("decimal"),
      stop: text("decimal"),
      target_rate: text("decimal"),
    };
    const { title, test, rate, start, stop, target_rate } = this.controls;
    title.maxLength = 200;
    this.element = el(
      "div",
      { class: "fields" },
      labelled("mapping.title", "Name of the recording", title),
      labelled("mapping.test", "Kind of test", test),
      labelled("mapping.rate", "Sampling rate of the file", rate, "needed only if no column is time", "Hz"),
      labelled("mapping.start", "Start", start, "in the file's time", "s"),
      labelled("mapping.stop", "Stop", stop, "in the file's time", "s"),
      labelled("mapping.target_rate", "Sampling rate of the recording", target_rate, "empty: the highest rate of the channels", "Hz"),
    );
  }

  /** @param {any} mapping @param {string} name */
  fill({ title, test, dt, rate, start, stop, target_rate }, name) {
    const values = { title: title || name, test: test ?? "", rate: rate ?? (dt ? 1 / dt : ""), start, stop, target_rate };
    for (const [key, control] of Object.entries(this.controls)) control.value = values[/** @type {keyof typeof values} */ (key)] ?? "";
  }

  read() {
    const { title, test, rate, start, stop, target_rate } = this.controls;
    return {
      title: title.value.trim(),
      test: test.value || null,
      rate: numeric(rate.value),
      start: numeric(start.value),
      stop: numeric(stop.value),
      target_rate: numeric(target_rate.value),
    };
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
