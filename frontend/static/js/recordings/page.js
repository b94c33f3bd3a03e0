// @ts-check
import { api } from "../api.js";
import { byId } from "../dom.js";
import { refusalOf } from "../files/refusal.js";
import { size } from "../format.js";
import { withinLimit } from "../limit.js";
import { Editor } from "./editor.js";
import { removal } from "./remove.js";
import { showSaved } from "./saved_list.js";

const input = /** @type {HTMLInputElement} */ (byId("file"));
const drop = byId("drop");
const status = byId("reading");
const roles = api.get("/recordings/roles");
let uploads = 0;

/** Open the mapping editor for a file that the service stores. @param {() => Promise<any>} sending @param {string} told */
async function edit(sending, told) {
  const mine = ++uploads;
  byId("refusal").replaceChildren();
  status.textContent = told;
  byId("work").replaceChildren();
  try {
    const [sent, known] = await Promise.all([sending(), roles]);
    if (mine !== uploads) return;
    history.replaceState(null, "", `?file=${sent.sha256}`);
    byId("work").replaceChildren(new Editor(sent, known, (recording) => location.assign(`/recordings/${recording.id}`), showSaved).element);
  } catch (error) {
    if (mine === uploads) byId("refusal").replaceChildren(refusalOf(error));
  }
  if (mine === uploads) status.textContent = "";
}

/** @param {File | undefined} file */
function upload(file) {
  if (!file) return;
  const send = () => {
    const form = new FormData();
    form.set("file", withinLimit(file));
    return api.postForm("/recordings/files", form);
  };
  edit(send, `Reading ${file.name}, ${size(file.size)} …`);
}

input.addEventListener("change", () => upload(input.files?.[0]));
for (const [event, over] of /** @type {[string, boolean][]} */ ([["dragover", true], ["dragleave", false], ["drop", false]])) {
  drop.addEventListener(event, (/** @type {DragEvent} */ e) => {
    e.preventDefault();
    drop.classList.toggle("over", over);
    if (event === "drop") upload(e.dataTransfer?.files[0]);
  });
}
removal(() => location.reload());
showSaved();

const kept = new URLSearchParams(location.search).get("file");
if (kept) edit(() => api.get(`/recordings/files/${encodeURIComponent(kept)}`), "Reading the file …");
