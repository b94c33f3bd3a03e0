// @ts-check
import { el, htmlElements } from "../dom.js";
import { drivePart } from "./drive.js";
import { offerIdentification } from "./identify.js";
import { knownPart } from "./known.js";
import { motionPart } from "./motion.js";
import { listPart } from "./list.js";
import { part, usedIn } from "./parts.js";
import { StationFold, countErrors } from "./station_fold.js";

/** @typedef {import("./field.js").Part} Part @typedef {import("./schema.js").Schema} Schema @typedef {{where: string, problem: string, fix?: string | null}} Problem */

/** The sections of the form: heading, title in the rail, and fields of the plan. */
const SECTIONS = [
  { title: "Test", short: "Test", names: ["test", "name", "notes"] },
  { title: "Client", short: "Client", names: ["client"] },
  { title: "Drive", short: "Drive", names: ["drive"] },
  { title: "Ground motion", short: "Ground motion", names: ["motion", "motion_physics"] },
  { title: "Forces on floors", short: "Forces on floors", names: ["forces"] },
  { title: "Start", short: "Start", names: ["start"] },
  { title: "Structure", short: "Structure", names: ["structure", "structure_physics"] },
  { title: "Integration and controller", short: "Integration", names: ["integrator", "controller_rate"] },
  { title: "Stations: actuator, specimen, compensator, limits", short: "Stations", names: ["stations"] },
  { title: "Specimens that stations share", short: "Shared specimens", names: ["couplings"] },
  { title: "How well the numbers are known", short: "Known numbers", names: ["known"] },
  { title: "Duration, pace and seed", short: "Duration and pace", names: ["duration", "pace", "seed"] },
];
const KEPT = ["schema", "template"];

/** The form of a plan, built from the plan's JSON schema. */
export class PlanForm {
  /** @param {HTMLElement} host @param {Schema} schema @param {any[]} records */
  constructor(host, schema, records) {
    this.host = host;
    this.schema = schema;
    this.records = records;
    /** @type {Map<string, Part>} */
    this.parts = new Map();
    /** @type {any} */
    this.kept = {};
    /** @type {import("./rail.js").Section[]} */
    this.sections = [];
    for (const event of ["input", "change"]) host.addEventListener(event, () => this.#refresh());
  }

  /** Fill the form with a plan. @param {any} plan */
  write(plan) {
    const properties = this.schema.root.properties;
    this.kept = Object.fromEntries(KEPT.map((name) => [name, plan[name] ?? null]));
    this.parts.clear();
    this.schema.test = plan.test ?? this.schema.initial(properties.test);
    this.sections = SECTIONS.map(({ title, short, names }) => {
      for (const name of names) this.parts.set(name, usedIn(this.schema, properties[name], this.#part(properties[name], name, plan[name])));
      const id = `section-${names[0]}`;
      const elements = names.map((name) => /** @type {Part} */ (this.parts.get(name)).element);
      const element = el("section", { "aria-labelledby": id }, el("h2", { id, tabindex: "-1" }, title), el("div", { class: "fields" }, ...elements));
      return { id, title: short, element };
    });
    this.host.replaceChildren(...this.sections.map(({ element }) => element));
    this.#refresh();
  }

  /** Show the fields that the selected kind of test uses. */
  #refresh() {
    this.schema.test = this.parts.get("test")?.read();
    for (const one of htmlElements(this.host.querySelectorAll("[data-tests]"))) one.hidden = !one.dataset.tests?.split(" ").includes(this.schema.test);
    for (const one of this.parts.values()) one.refresh?.();
    for (const section of htmlElements(this.host.children)) {
      section.hidden = htmlElements(section.querySelectorAll(":scope > .fields > *")).every((one) => one.hidden);
    }
  }

  /** @param {any} node @param {string} name @param {any} value */
  #part(node, name, value) {
    if (name === "motion") return motionPart(this.schema, node, value, this.records);
    if (name === "drive") return drivePart(this.schema, node, value ?? this.schema.initial(node), () => this.read());
    if (name === "known") return knownPart(this.schema, node, value ?? {}, () => this.parts.get("stations")?.read() ?? []);
    const filled = value ?? this.schema.initial(node);
    return name === "stations" ? this.#stations(node, filled) : part(this.schema, node, name, filled);
  }

  /** The stations, each folded to one line. @param {any} unresolved @param {any[]} values */
  #stations(unresolved, values) {
    const node = this.schema.resolve(unresolved);
    const item = this.schema.resolve(node.items);
    const fold = (/** @type {HTMLElement} */ fields, /** @type {number} */ index, /** @type {boolean} */ open) => {
      offerIdentification(fields, index, () => this.read());
      return new StationFold(this.schema, item, fields, index, open);
    };
    return listPart(this.schema, node, "stations", values, part, fold);
  }

  /** The plan in the form, in SI units. @returns {any} */
  read() {
    return { ...this.kept, ...Object.fromEntries([...this.parts].map(([name, one]) => [name, one.read()])) };
  }

  /** The errors that the form finds without the service, with bounds in the shown units. @returns {Problem[]} */
  problems() {
    return [...this.parts.values()].flatMap((one) => one.problems());
  }

  /** Show the first problem of each field beside the field. Returns the problems without a field. @param {Problem[]} problems */
  mark(problems) {
    for (const control of this.host.querySelectorAll("[aria-invalid]")) control.removeAttribute("aria-invalid");
    for (const place of this.host.querySelectorAll("small.error")) place.textContent = "";
    const without = problems.filter(({ where, problem, fix }) => {
      const control = this.control(where);
      const place = control && document.getElementById(`e-${control.dataset.path}`);
      if (!control || !place) return true;
      if (control.hasAttribute("aria-invalid")) return false;
      control.setAttribute("aria-invalid", "true");
      place.textContent = fix ? `${problem} (${fix})` : problem;
      return false;
    });
    countErrors(this.host);
    return without;
  }

  /** The control of a path, or the nearest enclosing control that can show an error. @param {string} where @returns {HTMLElement | null} */
  control(where) {
    for (let path = where; path; path = path.slice(0, Math.max(0, path.lastIndexOf(".")))) {
      const found = document.getElementById(`f-${path}`) ?? document.getElementById(`f-${path}.kind`) ?? this.#list(path);
      if (found) return found;
    }
    return null;
  }

  /** @param {string} path @returns {HTMLElement | null} */
  #list(path) {
    return document.getElementById(`e-${path}`) && this.host.querySelector(`.list[data-path="${CSS.escape(path)}"]`);
  }
}
