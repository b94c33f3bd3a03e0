// @ts-check
// A dialog that asks for a text, such as the reason of a rejection.
import { el } from "../dom.js";

/**
 * Ask for a text; resolves to it, or to "" where the person keeps everything as it is.
 * @param {string} title @param {string} label @param {string} action
 * @returns {Promise<string>}
 */
export function asked(title, label, action) {
  const field = el("input", { id: "asked-text", maxlength: 200, required: true, autocomplete: "off" });
  const form = el(
    "form",
    { class: "ask-box" },
    el("h2", { id: "asked-title" }, title),
    el("label", { for: "asked-text" }, label),
    field,
    el("div", { class: "actions" }, el("button", { type: "submit" }, action), el("button", { type: "button", class: "quiet", id: "asked-keep" }, "Cancel")),
  );
  const dialog = el("dialog", { class: "ask", "aria-labelledby": "asked-title" }, form);
  document.body.append(dialog);
  return new Promise((resolve) => {
    form.addEventListener("submit", (/** @type {Event} */ event) => {
      event.preventDefault();
      if (field.value.trim()) dialog.close("yes");
    });
    dialog.querySelector("#asked-keep").addEventListener("click", () => dialog.close());
    dialog.addEventListener("close", () => {
      resolve(dialog.returnValue === "yes" ? field.value.trim() : "");
      dialog.remove();
    });
    dialog.showModal();
    field.focus();
  });
}
