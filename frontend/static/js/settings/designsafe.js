// @ts-check
import { api, explain, sentence } from "../api.js";
import { byId, el } from "../dom.js";
import { noteSignIn } from "../signed_out.js";

const KEY = "rths.designsafe";
const form = byId("designsafe");
const address = `/runs/${form.dataset.run}/designsafe`;
/** @type {any[]} */
const fields = [...form.querySelectorAll("[data-path]")];

/** @param {any} field */
function value(field) {
  if ("list" in field.dataset) return field.value.split(",").map((/** @type {string} */ one) => one.trim()).filter(Boolean);
  if ("authors" in field.dataset) return field.value.split("\n").filter((/** @type {string} */ one) => one.trim()).map(author);
  return field.value.trim();
}

/** @param {string} line */
function author(line) {
  const [fname = "", lname = "", inst = ""] = line.split(";").map((one) => one.trim());
  return { fname, lname, inst };
}

/** The metadata as they stand in the form. */
function given() {
  /** @type {Record<string, any>} */
  const data = { project: {}, hybridSimulation: {} };
  for (const field of fields) {
    const [first, second] = field.dataset.path.split(".");
    if (second) data[first][second] = value(field);
    else data[first] = value(field);
  }
  return data;
}

function keep() {
  localStorage.setItem(KEY, JSON.stringify(Object.fromEntries(fields.map((field) => [field.dataset.path, field.value]))));
  for (const one of form.querySelectorAll("[data-length]")) one.textContent = String(byId(one.dataset.length).value.trim().length);
}

/** Show what is missing; before the first check, only the list of it. @param {import("../api.js").Problem[]} missing @param {boolean} beside */
function show(missing, beside) {
  for (const place of beside ? form.querySelectorAll("[data-wrong]") : []) {
    const own = missing.filter((one) => one.where === place.dataset.wrong || one.where.startsWith(`${place.dataset.wrong}.`));
    place.textContent = own.map((one) => [one.problem, one.fix && ` (${one.fix})`].filter(Boolean).join("")).join("; ");
  }
  byId("missing").replaceChildren(...missing.map((one) => el("li", {}, sentence(one))));
  byId("complete").textContent = missing.length ? `${missing.length} required ${missing.length === 1 ? "entry is" : "entries are"} missing.` : "Nothing is missing.";
}

/** @param {boolean} beside also beside the fields */
async function check(beside) {
  byId("refusal").textContent = "";
  try {
    const { missing } = await api.post(`${address}/check`, given());
    show(missing, beside);
    return missing.length === 0;
  } catch (error) {
    byId("refusal").textContent = explain(error);
    return false;
  }
}

/** @param {Event} event */
async function download(event) {
  event.preventDefault();
  if (!(await check(true))) return;
  const response = noteSignIn(await fetch(`/api/v1${address}.zip`, { method: "POST", body: JSON.stringify(given()), headers: { "Content-Type": "application/json" } }));
  if (!response.ok) {
    byId("refusal").textContent = `Not made: ${(await response.json()).detail}`;
    return;
  }
  const link = el("a", { href: URL.createObjectURL(await response.blob()), download: `${form.dataset.run}-designsafe.zip` });
  link.click();
  URL.revokeObjectURL(link.href);
}

const kept = JSON.parse(localStorage.getItem(KEY) ?? "{}");
for (const field of fields) field.value = kept[field.dataset.path] ?? field.value;
form.addEventListener("input", keep);
form.addEventListener("submit", download);
byId("check").addEventListener("click", () => check(true));
keep();
void check(false);
