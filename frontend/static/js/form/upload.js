// @ts-check
import { ApiError, api, sentence } from "../api.js";
import { el } from "../dom.js";
import { withinLimit } from "../limit.js";
import { labelled } from "./field.js";
import { previewOf } from "./preview.js";

const UNITS = ["g", "g/10", "mg", "m/s^2", "cm/s^2", "mm/s^2", "in/s^2", "ft/s^2"];

const QUIET_MS = 400;

/** The upload of a record: first a preview, then the entry in the library. @param {(motion: any) => void} added @returns {HTMLElement} */
export function uploadBox(added) {
  const file = el("input", { type: "file", accept: ".at2,.v0,.v1,.v2,.v0c,.v1c,.v2c,.raw,.smc,.txt,.csv,.dat,.tsv,.acc,text/*" });
  const unit = el("select", {}, el("option", { value: "" }, "from the file"), ...UNITS.map((name) => el("option", { value: name }, name)));
  const dt = el("input", { type: "text", inputmode: "decimal", placeholder: "from the file", autocomplete: "off" });
  const channel = el("input", { type: "text", placeholder: "name or number, if the file has several", autocomplete: "off" });
  const name = el("input", { type: "text", placeholder: "from the file's name", autocomplete: "off" });
  const told = el("p", { class: "error", role: "alert" });
  const shown = el("div");
  const add = el("button", { type: "button", on: { click: () => keep() } }, "Add to the library");
  add.disabled = true;

  const form = () => {
    const data = new FormData();
    data.set("file", withinLimit(file.files[0]));
    for (const [key, control] of Object.entries({ unit, dt, channel, name })) if (control.value.trim()) data.set(key, control.value.trim());
    return data;
  };
  const refused = (/** @type {unknown} */ error) => {
    if (!(error instanceof ApiError)) throw error;
    shown.replaceChildren();
    told.textContent = error.errors.map(sentence).join("; ") || error.message;
    const asked = error.errors.map((problem) => problem.where).find((where) => /(unit|dt|channel)$/.test(where ?? ""));
    if (asked) (asked.endsWith("dt") ? dt : asked.endsWith("unit") ? unit : channel).focus();
  };
  let looks = 0;
  const look = async () => {
    add.disabled = !file.files.length;
    if (!file.files.length) return shown.replaceChildren();
    const mine = ++looks;
    try {
      const preview = await api.postForm("/motions/preview", form());
      if (mine !== looks) return;
      told.textContent = "";
      shown.replaceChildren(previewOf(preview));
    } catch (error) {
      if (mine === looks) refused(error);
    }
  };
  let typing = 0;
  const lookSoon = () => {
    clearTimeout(typing);
    typing = setTimeout(look, QUIET_MS);
  };
  const keep = async () => {
    add.disabled = true;
    looks++;
    try {
      const motion = await api.postForm("/motions", form());
      shown.replaceChildren(el("p", { role: "status" }, `${motion.name} was added to the library and selected.`));
      file.value = "";
      added(motion);
    } catch (error) {
      add.disabled = false;
      refused(error);
    }
  };
  for (const control of [file, unit]) control.addEventListener("change", look);
  for (const control of [dt, channel]) control.addEventListener("input", lookSoon);

  const box = el(
    "details",
    { class: "upload" },
    el("summary", {}, "Upload a record: PEER AT2, COSMOS, CSMIP, SMC or columns of numbers"),
    el(
      "div",
      { class: "fields" },
      labelled("upload.file", "File", file),
      labelled("upload.unit", "Unit of the acceleration", unit),
      labelled("upload.dt", "Time step", dt, "", "s"),
      labelled("upload.channel", "Channel", channel),
      labelled("upload.name", "Name in the library", name),
    ),
    told,
    shown,
    add,
  );
  for (const event of ["input", "change"]) box.addEventListener(event, (/** @type {Event} */ e) => e.stopPropagation());
  return box;
}
