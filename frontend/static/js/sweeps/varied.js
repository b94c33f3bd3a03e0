// @ts-check
import { el } from "../dom.js";
import { listed, tidy, typed } from "./typed.js";

/**
 * A number of a plan that can vary (`/sweeps/fields`), in SI but for `shown`.
 * @typedef {{path: string, label: string, shown: string, shown_label: string, factor: number, whole: boolean, value: number | null, lowest: number | null, highest: number | null}} Field
 */

/** @type {Record<string, [string, string][]>} inputs of each distribution: key and label */
const OF_KIND = {
  uniform: [["lower", "Lower end"], ["upper", "Upper end"]],
  normal: [["mean", "Mean"], ["sd", "Standard deviation"], ["lower", "Truncated at, from"], ["upper", "Truncated at, to"]],
  lognormal: [["median", "Median"], ["sigma_ln", "Dispersion (of ln x)"], ["lower", "Truncated at, from"], ["upper", "Truncated at, to"]],
};
const OPTIONAL = { normal: ["lower", "upper"], lognormal: ["lower", "upper"], uniform: [] };

/** The card of one varied field: how it varies, and its values in the unit shown. */
export class Varied {
  /** @param {Field} field @param {boolean} sampled @param {() => void} changed @param {(card: Varied) => void} remove @param {any} [given] the field in an earlier definition */
  constructor(field, sampled, changed, remove, given) {
    this.field = field;
    this.changed = changed;
    /** @type {Record<string, any>} */
    this.inputs = {};
    const every = /^(stations|structure\.storeys)\.\d+\./;
    const title = field.label;
    this.change = select([["set", "Set the value"], ["multiply", "Multiply the planned value"]], given?.change ?? "set");
    this.every = every.test(field.path) ? el("input", { type: "checkbox", checked: given?.path?.includes?.(".*.") ?? false }) : null;
    this.how = select(sampled ? [["uniform", "Uniform"], ["normal", "Normal"], ["lognormal", "Lognormal"]] : [["values", "List"], ["range", "Range"]], howOf(given, sampled));
    this.body = el("div", { class: "row" });
    this.error = el("small", { class: "error", role: "alert" });
    const [low, high] = [field.lowest, field.highest].map((one) => (one === null ? "" : `${tidy(one / field.factor)}`));
    const bounds = low || high ? `, bounds ${low || "−∞"} to ${high || "∞"} ${field.shown_label}` : "";
    const planned = field.value === null ? "not set" : `${tidy(field.value / field.factor)} ${field.shown_label}`.trimEnd();
    this.element = el(
      "fieldset",
      { class: "varied" },
      el("header", {}, el("strong", {}, title), el("code", {}, field.path), el("button", { type: "button", class: "quiet small", "aria-label": `Remove ${title}`, on: { click: () => remove(this) } }, "Remove")),
      el("p", { class: "hint" }, `Planned: ${planned}${bounds}${field.whole ? ", whole numbers" : ""}`),
      el("div", { class: "row" }, el("label", {}, "Values as", this.how), el("label", {}, "Change", this.change), this.every && el("label", {}, this.every, " The same value at every station or storey")),
      this.body,
      this.error,
    );
    this.how.addEventListener("change", () => this.#build());
    this.change.addEventListener("change", () => this.#build());
    this.element.addEventListener("input", changed);
    this.#build(given);
  }

  get unit() {
    return this.change.value === "multiply" ? "" : this.field.shown_label;
  }

  /** Offer the methods' ways to give values. @param {boolean} sampled */
  offer(sampled) {
    const was = this.how.value;
    const ways = sampled ? ["uniform", "normal", "lognormal"] : ["values", "range"];
    if (ways.includes(was)) return;
    const words = { uniform: "Uniform", normal: "Normal", lognormal: "Lognormal", values: "List", range: "Range" };
    this.how.replaceChildren(...ways.map((way) => el("option", { value: way }, words[/** @type {keyof typeof words} */ (way)])));
    this.#build();
  }

  /** @param {any} [given] */
  #build(given) {
    this.inputs = {};
    const { value, factor } = this.field;
    const near = this.change.value === "multiply" ? 1 : value === null ? null : value / factor;
    const about = (/** @type {number} */ share) => (near === null ? "" : tidy(near * share));
    const say = (/** @type {any} */ one) => this.#said(one, given);
    const box = (/** @type {string} */ key, /** @type {string} */ label, /** @type {any} */ start, unit = this.unit) => {
      this.inputs[key] = el("input", { value: start ?? "", autocomplete: "off", inputmode: key === "values" ? "text" : "decimal" });
      return el("label", {}, unit ? `${label}, ${unit}` : label, this.inputs[key]);
    };
    const how = this.how.value;
    if (how === "values") {
      this.body.replaceChildren(box("values", "Values, with commas between them", given?.values ? given.values.map(say).join(", ") : [0.8, 1, 1.2].map(about).filter(Boolean).join(", ")));
    } else if (how === "range") {
      const range = given?.range;
      this.inputs.spacing = select([["linear", "Equal differences"], ["log", "Equal ratios"]], range?.spacing ?? "linear");
      this.body.replaceChildren(
        box("from", "From", range ? say(range.from) : about(0.5)),
        box("to", "To", range ? say(range.to) : about(1.5)),
        box("count", "Number of values", range?.count ?? 5, ""),
        el("label", {}, "Spacing", this.inputs.spacing),
      );
    } else {
      const starts = { lower: how === "uniform" ? about(0.8) : "", upper: how === "uniform" ? about(1.2) : "", mean: about(1), median: about(1), sd: about(0.1), sigma_ln: "0.2" };
      const law = given?.distribution;
      this.body.replaceChildren(
        ...OF_KIND[how].map(([key, label]) => box(key, label, law ? (law[key] == null ? "" : key === "sigma_ln" ? law[key] : say(law[key])) : starts[/** @type {keyof typeof starts} */ (key)], key === "sigma_ln" ? "" : this.unit)),
      );
    }
    this.changed();
  }

  /** A value of an earlier definition in the unit shown. @param {any} value @param {any} given */
  #said(value, given) {
    if (typeof value !== "number" || given.change === "multiply" || given.unit === this.field.shown) return value;
    return given.unit ? `${value} ${given.unit}` : tidy(value / this.field.factor);
  }

  /** The field as the definition has it. */
  read() {
    const { inputs } = this;
    const path = this.every?.checked ? this.field.path.replace(/\.\d+\./, ".*.") : this.field.path;
    const set = this.change.value === "set";
    const found = { path, ...(set && this.field.shown !== "1" ? { unit: this.field.shown } : {}), ...(set ? {} : { change: "multiply" }) };
    const how = this.how.value;
    if (how === "values") return { ...found, values: listed(inputs.values.value) };
    if (how === "range") {
      return { ...found, range: { from: typed(inputs.from.value), to: typed(inputs.to.value), count: typed(inputs.count.value), spacing: inputs.spacing.value } };
    }
    const missing = OPTIONAL[/** @type {keyof typeof OPTIONAL} */ (how)];
    const numbers = OF_KIND[how].map(([key]) => [key, inputs[key].value.trim()]).filter(([key, text]) => text !== "" || !missing.includes(/** @type {never} */ (key)));
    return { ...found, distribution: { kind: how, ...Object.fromEntries(numbers.map(([key, text]) => [key, typed(text)])) } };
  }

  /** @param {string} text */
  complain(text) {
    this.error.textContent = text;
    this.element.classList.toggle("wrong", text !== "");
  }
}

/** @param {any} given @param {boolean} sampled */
function howOf(given, sampled) {
  if (given?.distribution && sampled) return given.distribution.kind;
  if (sampled) return "uniform";
  return given?.range ? "range" : "values";
}

/** @param {[string, string][]} options @param {string} value */
function select(options, value) {
  const box = el("select", {}, ...options.map(([key, label]) => el("option", { value: key }, label)));
  box.value = options.some(([key]) => key === value) ? value : options[0][0];
  return box;
}
