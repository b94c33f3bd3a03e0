// @ts-check
// The glossary behind labels, and the list behind "?".
import { el } from "../dom.js";
import { shortcutList } from "./shortcuts.js";
import { glossary, termOf, termsOnPage } from "./terms.js";

/** @typedef {import("./terms.js").Term} Term */

const REST_MS = 350; // before a term is explained
const GAP = 6; // pixels between a label and its explanation

const note = el("div", { class: "term-note", role: "tooltip", id: "term-note", popover: "manual" });
document.body.append(note);
/** @type {ReturnType<typeof setTimeout> | undefined} */
let resting;

/** Explain the term under the pointer. @param {Element} element */
async function explain(element) {
  const term = termOf(element, await glossary());
  if (!term || !element.isConnected) return;
  note.replaceChildren(...described(term));
  note.showPopover();
  const label = element.getBoundingClientRect();
  const box = note.getBoundingClientRect();
  const below = label.bottom + GAP + box.height < innerHeight;
  note.style.left = `${Math.max(GAP, Math.min(label.left, innerWidth - box.width - GAP))}px`;
  note.style.top = `${below ? label.bottom + GAP : Math.max(GAP, label.top - GAP - box.height)}px`;
}

function hide() {
  clearTimeout(resting);
  if (note.matches(":popover-open")) note.hidePopover();
}

/** @param {Term} term @returns {(Node | string)[]} */
function described({ term, symbol, unit, meaning }) {
  const facts = [symbol !== term && symbol, unit && `in ${unit}`].filter(Boolean).join(", ");
  return [el("strong", {}, term), facts ? ` (${facts}): ` : ": ", meaning];
}

document.addEventListener("pointerover", (event) => {
  hide();
  if (event.pointerType !== "touch" && event.target instanceof Element) {
    const element = event.target;
    resting = setTimeout(() => explain(element).catch(() => null), REST_MS);
  }
});
document.addEventListener("pointerdown", hide);
document.addEventListener("click", (event) => {
  if (/** @type {PointerEvent} */ (event).pointerType === "touch" && event.target instanceof Element) explain(event.target).catch(() => null);
});
addEventListener("scroll", hide, { passive: true, capture: true });

/** Show the shortcuts of this page and the terms on it. */
async function showAll() {
  const terms = termsOnPage(await glossary());
  const close = el("button", { type: "button", class: "quiet", autofocus: true }, "Close the help");
  const dialog = el(
    "dialog",
    { class: "help-dialog", "aria-labelledby": "help-dialog-title" },
    el(
      "article",
      {},
      el("h2", { id: "help-dialog-title" }, "Help on this page"),
      el("form", { class: "help-search", action: "/help", role: "search" }, el("label", { for: "help-dialog-q" }, "Search the help"), el("input", { id: "help-dialog-q", name: "q", type: "search", maxlength: 200 }), el("button", { type: "submit" }, "Search")),
      el("h3", {}, "Keyboard"),
      el("dl", { class: "shortcuts" }, ...shortcutList(location.pathname)),
      terms.length ? el("h3", {}, "Terms on this page") : null,
      terms.length ? el("ul", { class: "terms", tabindex: 0, "aria-label": "Terms on this page" }, ...terms.map((term) => el("li", {}, ...described(term)))) : null,
      el("p", { class: "actions" }, close, el("a", { href: "/help" }, "All documents"), el("a", { href: "/help/docs/glossary.md" }, "Glossary")),
    ),
  );
  close.addEventListener("click", () => dialog.close());
  dialog.addEventListener("close", () => dialog.remove());
  document.body.append(dialog);
  dialog.showModal();
}

document.addEventListener("keydown", (event) => {
  if (event.key === "Escape") hide();
  const typing = event.target instanceof Element && event.target.closest("input, select, textarea, [contenteditable]");
  if (event.key !== "?" || typing || document.querySelector("dialog[open]")) return;
  event.preventDefault();
  showAll().catch(() => null);
});
