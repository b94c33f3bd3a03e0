// @ts-check
import { api, explain } from "../api.js";
import { byId, el } from "../dom.js";

/**
 * What the dialog saves: the plan in the form, the user's name, the version that the plan was opened from, and its draft.
 * @typedef {{plan: any, by: string, library: {id: string, name: string, version: number} | null, draft: string | null}} Asked
 * @typedef {{id: string, name: string, version: {number: number}, created: boolean}} Saved
 */

const dialog = byId("keep-dialog");
const name = byId("keep-name");
const comment = byId("keep-comment");
const wrong = byId("keep-wrong");
/** @type {Asked} */
let asked;
/** @type {(saved: Saved) => void} */
let done = () => {};

/** Ask for name and comment, save to the library, and tell the result. @param {Asked} what @param {(saved: Saved) => void} saved */
export function saveToLibrary(what, saved) {
  asked = what;
  done = saved;
  const { library, plan } = what;
  const choices = library
    ? [choice("version", `New version of ${library.name}`, true), choice("new", "New plan", false)]
    : [];
  byId("keep-as").replaceChildren(...choices);
  name.value = plan.name ?? "";
  comment.value = "";
  wrong.textContent = "";
  showName();
  dialog.showModal();
  (library ? comment : name).focus();
}

/** @param {string} value @param {string} label @param {boolean} checked */
function choice(value, label, checked) {
  return el("label", {}, el("input", { type: "radio", name: "keep-as", value, checked, on: { change: showName } }), label);
}

const asVersion = () => dialog.querySelector("[name=keep-as]:checked")?.value === "version";

function showName() {
  byId("keep-name-field").hidden = asVersion();
}

/** @param {Event} event */
async function save(event) {
  event.preventDefault();
  const { plan, by, library, draft } = asked;
  const body = { plan, comment: comment.value, saved_by: by, draft };
  try {
    const saved =
      library && asVersion()
        ? await api.post(`/library/plans/${library.id}/versions`, body)
        : await api.post("/library/plans", { ...body, name: name.value.trim() || plan.name });
    dialog.close();
    done(saved);
  } catch (error) {
    wrong.textContent = explain(error);
  }
}

dialog.querySelector("form").addEventListener("submit", save);
byId("keep-cancel").addEventListener("click", () => dialog.close());
