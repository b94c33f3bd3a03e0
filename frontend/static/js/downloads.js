// @ts-check
import { el } from "./dom.js";

/** @typedef {[label: string, href: string, saved?: boolean]} Download `saved`: stored as a file instead of opened */

/** A menu of downloads. It closes by Escape, by a click elsewhere and by a choice. @param {Download[]} links @returns {HTMLElement} */
export function downloadMenu(links) {
  const items = links.map(([label, href, saved = false]) => el("li", {}, el("a", { href, download: saved }, label)));
  const menu = el("details", { class: "downloads" }, el("summary", { class: "button quiet" }, "Download"), el("ul", {}, ...items));
  closes(menu);
  return menu;
}

/** @param {HTMLDetailsElement} menu */
function closes(menu) {
  menu.addEventListener("keydown", (event) => {
    if (event.key !== "Escape" || !menu.open) return;
    menu.open = false;
    menu.querySelector("summary")?.focus();
  });
  menu.addEventListener("click", (event) => {
    if (event.target instanceof HTMLAnchorElement) menu.open = false;
  });
  const elsewhere = (/** @type {Event} */ event) => {
    if (event.target instanceof Node && !menu.contains(event.target)) menu.open = false;
  };
  menu.addEventListener("toggle", () => {
    const list = menu.querySelector("ul");
    menu.classList.remove("up");
    if (menu.open && list && list.getBoundingClientRect().bottom > innerHeight) menu.classList.add("up");
    if (menu.open) document.addEventListener("click", elsewhere);
    else document.removeEventListener("click", elsewhere);
  });
}

/** Let the menus that a page already has close likewise. */
for (const menu of document.querySelectorAll("details.downloads")) closes(/** @type {HTMLDetailsElement} */ (menu));
