// @ts-check
import { api } from "../api.js";
import { byId } from "../dom.js";
import { refusalOf } from "../files/refusal.js";
import { size } from "../format.js";
import { person, remember } from "../person.js";

const form = byId("many");
const files = byId("many-files");
const chosen = byId("many-mapping");
const yaml = byId("many-yaml");
const who = byId("many-who");
const button = /** @type {HTMLButtonElement} */ (form.querySelector("[type=submit]"));

/** A field of the form that is not filled in correctly. */
class Wrong extends Error {
  /** @param {any} field @param {string} message */
  constructor(field, message) {
    super(message);
    this.field = field;
  }
}

/** The chosen files, if there are any and they are not larger than the limit together. @returns {File[]} */
function chosenFiles() {
  const some = /** @type {File[]} */ ([...files.files]);
  const most = Number(form.dataset.limitMb);
  const whole = some.reduce((sum, one) => sum + one.size, 0);
  if (!some.length) throw new Wrong(files, "Choose files of measurements, or a ZIP archive of such files.");
  if (whole > most * 1e6) throw new Wrong(files, `The files are too large: ${size(whole)}. The largest accepted size is ${most} MB: choose fewer files, or a ZIP archive of them.`);
  return some;
}

/** The text of the chosen mapping: of a file, or as the service stores it. @returns {Promise<string>} */
async function mapping() {
  if (chosen.value) return JSON.stringify((await api.get(chosen.value)).mapping);
  const [file] = yaml.files;
  if (!file) throw new Wrong(yaml, "Choose a mapping in the list, or a YAML file with a mapping.");
  return file.text();
}

/** @param {Event} event */
async function send(event) {
  event.preventDefault();
  for (const place of form.querySelectorAll("small.error, #many-refusal, #many-status")) place.replaceChildren();
  for (const field of [files, yaml]) field.removeAttribute("aria-invalid");
  button.disabled = true;
  try {
    const body = new FormData();
    for (const one of chosenFiles()) body.append("files", one);
    body.set("mapping", await mapping());
    body.set("imported_by", who.value.trim());
    body.set("trust_mapping", String(byId("many-trust").checked));
    remember(who.value.trim());
    byId("many-status").textContent = `Importing ${files.files.length === 1 ? files.files[0].name : `${files.files.length} files`} …`;
    const batch = await api.postForm("/recordings/batches", body);
    location.assign(`/recordings/batches/${batch.id}`);
  } catch (error) {
    byId("many-status").textContent = "";
    button.disabled = false;
    if (error instanceof Wrong) {
      byId(`${error.field.id}-error`).textContent = error.message;
      error.field.setAttribute("aria-invalid", "true");
      error.field.focus();
    } else byId("many-refusal").replaceChildren(refusalOf(error));
  }
}

who.value = person();
form.addEventListener("submit", send);
chosen.addEventListener("change", () => (yaml.closest(".field").hidden = Boolean(chosen.value)));
yaml.closest(".field").hidden = Boolean(chosen.value);
