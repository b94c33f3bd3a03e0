// @ts-check
import { api, ApiError, explain, sentence } from "../api.js";
import { byId, el } from "../dom.js";
import { person } from "../person.js";
import { previewed } from "./preview.js";
import { listOrRange, tidy, typed } from "./typed.js";
import { Varied } from "./varied.js";

const AFTER_MS = 400; // of rest before a preview is asked for
const MOST_FOUND = 40;
const SAMPLED = ["latin_hypercube", "monte_carlo"];

/** @type {any} */
let plan = null;
/** @type {import("./varied.js").Field[]} */
let fields = [];
/** @type {Varied[]} */
let cards = [];
let waiting = 0;
/** @type {AbortController | null} */
let asking = null;

const sampled = () => SAMPLED.includes(byId("method").value);
const complain = (/** @type {unknown} */ error) => (byId("refusal").textContent = explain(error));

/** The plan that a choice names, and the definition of an earlier sweep. @param {string} choice @returns {Promise<{plan: any, sweep?: any}>} */
async function load(choice) {
  const [kind, id, version] = choice.split(":");
  if (kind === "template") return { plan: (await api.get(`/templates/${id}`)).plan };
  if (kind === "run") return { plan: (await api.get(`/runs/${id}`)).plan };
  if (kind === "library") {
    const number = version ?? (await api.get(`/library/plans/${id}`)).versions;
    return { plan: (await api.get(`/library/plans/${id}/versions/${number}`)).plan };
  }
  const { sweep } = await api.get(`/sweeps/${id}`);
  return { plan: sweep.plan, sweep };
}

/** Take the base plan: its fields can vary, and cards whose field it does not have are removed. */
async function takeBase() {
  try {
    const found = await load(byId("base").value);
    plan = found.plan;
    ({ fields } = await api.post("/sweeps/fields", plan));
    byId("refusal").textContent = "";
    if (found.sweep) fill(found.sweep);
    else {
      const kept = new Set(fields.map(({ path }) => path));
      cards.filter(({ field }) => !kept.has(field.path)).forEach(remove);
      if (!byId("name").value || byId("name").dataset.made) {
        byId("name").value = `Sweep of ${plan.name}`.slice(0, 200);
        byId("name").dataset.made = "yes";
      }
    }
    byId("motion-part").hidden = !["hybrid", "structure"].includes(plan.test ?? "hybrid");
    search();
    changed();
  } catch (error) {
    complain(error);
  }
}

/** Fill the form from an earlier definition. @param {any} sweep */
function fill(sweep) {
  byId("name").value = sweep.name;
  byId("method").value = sweep.method;
  byId("samples").value = sweep.samples ?? 100;
  byId("seed").value = sweep.seed ?? 0;
  cards = [];
  for (const given of sweep.fields ?? []) {
    const path = [given.path].flat()[0].replace(".*.", ".0.");
    const field = fields.find((one) => one.path === path);
    if (field) add(field, given);
  }
  for (const box of byId("records").querySelectorAll("input")) box.checked = (sweep.records ?? []).includes(box.value);
  byId("scale").value = sweep.scales?.kind ?? "";
  if (sweep.scales) byId("scale-values").value = scalesOf(sweep.scales);
}

/** @param {any} scales */
function scalesOf({ kind, unit, values, range }) {
  const si = kind !== "factor" && !unit;
  const say = (/** @type {any} */ one) => (typeof one === "number" && si ? tidy(one / 9.80665) : one);
  return range ? `${say(range.from)} to ${say(range.to)} in ${range.count}` : values.map(say).join(", ");
}

/** The definition as it stands in the form. */
function read() {
  const records = [...byId("records").querySelectorAll("input:checked")].map((box) => box.value);
  const kind = byId("scale").value;
  return {
    name: byId("name").value.trim() || "Untitled sweep",
    plan,
    method: byId("method").value,
    fields: cards.map((card) => card.read()),
    ...(sampled() ? { samples: typed(byId("samples").value), seed: typed(byId("seed").value) } : {}),
    ...(records.length ? { records } : {}),
    ...(kind ? { scales: { kind, ...(kind === "factor" ? {} : { unit: "g" }), ...listOrRange(byId("scale-values").value) } } : {}),
  };
}

/** Show what follows from the choices, and ask for a preview once they rest. */
function changed() {
  for (const label of document.querySelectorAll(".sampled")) /** @type {HTMLElement} */ (label).hidden = !sampled();
  byId("scale-values-label").hidden = !byId("scale").value;
  const records = byId("records").querySelectorAll("input:checked").length;
  byId("records-count").textContent = records ? `${records} chosen` : "as planned";
  byId("queue").disabled = true;
  byId("queue").textContent = "Queue sweep";
  clearTimeout(waiting);
  const definition = plan && read();
  if (!definition || !(definition.fields.length || definition.records || definition.scales)) {
    byId("preview").replaceChildren(el("p", { class: "muted" }, "Add a field, a record or a scale."));
    return;
  }
  waiting = setTimeout(() => ask(definition), AFTER_MS);
}

/** @param {any} definition */
async function ask(definition) {
  asking?.abort();
  asking = new AbortController();
  try {
    const found = await api.post("/sweeps/preview", definition, asking.signal);
    cards.forEach((card) => card.complain(""));
    byId("preview").replaceChildren(...previewed(found));
    byId("queue").disabled = false;
    byId("queue").textContent = `Queue sweep of ${found.points} ${found.points === 1 ? "point" : "points"}`;
  } catch (error) {
    if (error instanceof DOMException) return;
    showErrors(error);
  }
}

/** Errors beside their field, and the others in the preview. @param {unknown} error */
function showErrors(error) {
  const errors = error instanceof ApiError ? error.errors : [];
  const of = (/** @type {number} */ k) => errors.filter(({ where }) => where === `fields.${k}` || where.startsWith(`fields.${k}.`));
  cards.forEach((card, k) => card.complain(of(k).map((one) => sentence({ ...one, where: "" })).join("; ")));
  const others = errors.filter(({ where }) => !/^fields\.\d+/.test(where));
  const words = others.length ? others.map(sentence) : errors.length ? ["Correct the fields that are marked."] : [explain(error)];
  byId("preview").replaceChildren(...words.map((text) => el("p", { class: "note bad" }, text)));
}

/** @param {import("./varied.js").Field} field @param {any} [given] */
function add(field, given) {
  const card = new Varied(field, sampled(), changed, remove, given);
  cards.push(card);
  byId("varied").replaceChildren(...cards.map(({ element }) => element));
  if (!given) card.element.querySelector("input, select")?.focus();
  search();
}

/** @param {Varied} card */
function remove(card) {
  cards = cards.filter((one) => one !== card);
  byId("varied").replaceChildren(...(cards.length ? cards.map(({ element }) => element) : [el("p", { class: "empty" }, "No field is varied yet. Search for a field of the plan and add it.")]));
  search();
  changed();
}

/** The fields whose label or path has every word that is searched for. */
function search() {
  const words = byId("search").value.toLowerCase().split(/\s+/).filter(Boolean);
  const used = new Set(cards.map(({ field }) => field.path));
  const fits = fields.filter(({ label, path }) => !used.has(path) && words.every((/** @type {string} */ word) => label.toLowerCase().includes(word) || path.toLowerCase().includes(word)));
  const offer = (/** @type {import("./varied.js").Field} */ field) => {
    const value = field.value === null ? "not set" : `${tidy(field.value / field.factor)} ${field.shown_label}`;
    const pick = () => {
      byId("search").value = "";
      add(field);
      changed();
    };
    return el("li", {}, el("button", { type: "button", on: { click: pick } }, field.label, el("small", {}, `${field.path} · planned ${value}`)));
  };
  byId("found").replaceChildren(...(words.length ? fits.slice(0, MOST_FOUND).map(offer) : []));
  const more = fits.length > MOST_FOUND ? ` The first ${MOST_FOUND} are shown.` : "";
  byId("search-words").textContent = words.length ? `${fits.length} fields found.${more}` : "All numbers of the plan can vary. Each is listed with its path, its planned value and its bounds.";
}

/** @param {SubmitEvent} event */
async function queue(event) {
  event.preventDefault();
  if (event.submitter !== byId("queue")) return;
  byId("queue").disabled = true;
  try {
    const made = await api.post("/sweeps", { sweep: read(), submitted_by: person() });
    location.href = `/sweeps/${made.id}`;
  } catch (error) {
    showErrors(error);
    complain(error);
  }
}

/** The base that the address names, as a first option. */
function given() {
  const asked = new URLSearchParams(location.search);
  const template = asked.get("template");
  if (template) return `template:${template}`;
  for (const [name, kind, words] of [["run", "run", "This run"], ["library", "library", "This plan of the library"], ["from", "sweep", "This sweep"]]) {
    const id = asked.get(name);
    if (!id) continue;
    byId("given").hidden = false;
    const version = name === "library" && asked.get("version");
    const value = version ? `${kind}:${id}:${version}` : `${kind}:${id}`;
    byId("given").append(el("option", { value }, words));
    return value;
  }
  return "";
}

const chosen = given();
if (chosen) byId("base").value = chosen;
byId("base").addEventListener("change", takeBase);
byId("name").addEventListener("input", () => delete byId("name").dataset.made);
byId("search").addEventListener("input", search);
byId("search").addEventListener("keydown", (/** @type {KeyboardEvent} */ event) => event.key === "Enter" && event.preventDefault());
byId("method").addEventListener("change", () => cards.forEach((card) => card.offer(sampled())));
byId("sweep").addEventListener("input", (/** @type {Event} */ event) => event.target !== byId("search") && changed());
byId("sweep").addEventListener("submit", queue);
byId("sweep").addEventListener("keydown", (/** @type {KeyboardEvent} */ event) => {
  const { target } = event;
  if (event.key === "Enter" && target instanceof HTMLInputElement) event.preventDefault(); // Enter in a field queues nothing
});
try {
  const { motions } = await api.get("/motions");
  byId("records").replaceChildren(...motions.map((/** @type {any} */ { name, title }) => el("label", {}, el("input", { type: "checkbox", value: name }), ` ${title}`)));
} catch (error) {
  complain(error);
}
takeBase();
