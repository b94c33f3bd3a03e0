// @ts-check
import { el } from "../dom.js";

const SHOWN_MS = 12_000;
/** @type {ReturnType<typeof setTimeout>} */
let timer;

/** Say what was done, with a way to undo it. @param {string} words @param {(() => void) | null} [undo] @param {boolean} [bad] */
export function toast(words, undo = null, bad = false) {
  const host = document.getElementById("toast") ?? document.body.appendChild(el("div", { id: "toast", class: "toast", role: "status" }));
  const close = () => (host.hidden = true);
  const button = undo && el("button", { type: "button", class: "quiet small", on: { click: () => { close(); undo(); } } }, "Undo");
  host.classList.toggle("bad", bad);
  host.replaceChildren(el("span", {}, words), ...(button ? [button] : []), el("button", { type: "button", class: "quiet small", "aria-label": "Close the message", on: { click: close } }, "✕"));
  host.hidden = false;
  clearTimeout(timer);
  timer = setTimeout(close, SHOWN_MS);
}
