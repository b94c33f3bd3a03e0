// @ts-check
import { el } from "./dom.js";

/**
 * Ask before something happens, in a dialog of the page. Escape and the last button answer no; the focus starts on it and
 * returns to where it was.
 * @param {{title: string, text?: string | Node, yes: string, no: string, danger?: boolean}} question
 * @returns {Promise<boolean>}
 */
export function ask({ title, text = "", yes, no, danger = false }) {
  return new Promise((resolve) => {
    const dialog = el("dialog", { class: "ask", "aria-labelledby": "ask-title" });
    const answer = (/** @type {boolean} */ said) => () => {
      dialog.returnValue = said ? "yes" : "";
      dialog.close();
    };
    const stay = el("button", { type: "button", class: "quiet", on: { click: answer(false) } }, no);
    dialog.append(
      el(
        "div",
        { class: "ask-box" },
        el("h2", { id: "ask-title" }, title),
        typeof text === "string" ? el("p", {}, text) : text,
        el("div", { class: "actions" }, el("button", { type: "button", class: danger ? "danger" : "", on: { click: answer(true) } }, yes), stay),
      ),
    );
    dialog.addEventListener("close", () => {
      dialog.remove();
      resolve(dialog.returnValue === "yes");
    });
    document.body.append(dialog);
    dialog.showModal();
    stay.focus();
  });
}
