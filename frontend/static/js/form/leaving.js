// @ts-check
import { ask } from "../ask.js";

/**
 * Ask before an edited form is left: by a link of the page in a dialog, by closing or reloading the page in the browser's own.
 * @param {() => boolean} edited whether something would be left behind
 * @param {() => Promise<void>} save saves the edits as a draft before the page is left
 * @returns {() => void} leave without asking from now on
 */
export function askBeforeLeaving(edited, save) {
  let free = false;
  addEventListener("beforeunload", (event) => {
    if (!free && edited()) event.preventDefault();
  });
  document.addEventListener("click", async (event) => {
    const link = /** @type {Element} */ (event.target).closest?.("a[href]");
    if (free || event.defaultPrevented || event.button || modified(event) || !(link instanceof HTMLAnchorElement) || !leads(link) || !edited()) return;
    event.preventDefault();
    const text = "The test is not queued. The draft is kept: you find it on the pages Plans and New test.";
    if (!(await ask({ title: "Leave the edited form?", text, yes: "Leave the form", no: "Stay on the form" }))) return;
    await save();
    free = true;
    location.assign(link.href);
  });
  return () => void (free = true);
}

/** @param {MouseEvent} event */
const modified = (event) => event.ctrlKey || event.metaKey || event.shiftKey || event.altKey;

/** Whether a link leads away from this page in this window. @param {HTMLAnchorElement} link */
function leads(link) {
  const here = link.origin === location.origin && link.pathname === location.pathname && link.search === location.search;
  return !link.target && !link.hasAttribute("download") && !(here && link.hash);
}
