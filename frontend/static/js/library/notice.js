// @ts-check
import { explain } from "../api.js";
import { byId, el } from "../dom.js";

/** Say what was done in #notice, with a button that undoes it. @param {string} text @param {() => Promise<void>} [undo] */
export function notice(text, undo) {
  const button = undo && el("button", { type: "button", class: "quiet small", on: { click: () => attempt(undo) } }, "Undo");
  byId("notice").replaceChildren(el("p", { class: "notice" }, el("span", {}, text), button));
}

/** Do something, and say in #notice why it failed. @param {() => Promise<void>} act */
export async function attempt(act) {
  try {
    await act();
  } catch (error) {
    byId("notice").replaceChildren(el("p", { class: "banner bad", role: "alert" }, explain(error)));
  }
}
