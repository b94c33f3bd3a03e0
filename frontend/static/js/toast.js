// @ts-check
// Short messages in the corner of the page. They leave after a while, and stay while the pointer or the focus is on them.
import { el } from "./dom.js";

const STAYS_MS = 12_000;
/** @type {any} */
let stack = null;

/**
 * Show a message. `tone` is "good", "bad" or "" and colours its edge; `more` are links and buttons.
 * @param {string} text @param {{tone?: string, more?: Node[]}} [options]
 */
export function toast(text, { tone = "", more = [] } = {}) {
  stack ??= document.body.appendChild(el("div", { class: "toasts", role: "region", "aria-label": "Messages" }));
  const close = el("button", { type: "button", class: "quiet small", "aria-label": "Close the message" }, "×");
  const body = el("p", { role: tone === "bad" ? "alert" : "status" }, text);
  const node = el("div", { class: `toast ${tone}` }, body, el("div", { class: "actions" }, ...more, close));
  let timer = 0;
  const leave = () => (timer = setTimeout(() => node.remove(), STAYS_MS));
  const stay = () => clearTimeout(timer);
  close.addEventListener("click", () => node.remove());
  for (const event of ["pointerenter", "focusin"]) node.addEventListener(event, stay);
  for (const event of ["pointerleave", "focusout"]) node.addEventListener(event, () => (stay(), leave()));
  stack.append(node);
  leave();
  return node;
}
