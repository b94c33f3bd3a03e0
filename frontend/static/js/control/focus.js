// @ts-check
// Keeps the focus of the keyboard where a part of a page is drawn anew.

/** @param {Element} node */
const label = (node) => node.getAttribute("aria-label") ?? node.textContent;

/**
 * Draw buttons anew. A focus inside of `host` stays on the button of the same label, or else goes to the first one left, or to the title.
 * @param {HTMLElement} host @param {() => void} draw
 */
export function keepingFocus(host, draw) {
  const focused = document.activeElement;
  const inside = focused !== null && host.contains(focused);
  draw();
  if (!inside || host.contains(document.activeElement)) return;
  const buttons = [...host.querySelectorAll("button")];
  const title = /** @type {HTMLElement} */ (document.querySelector("h1"));
  title.tabIndex = -1;
  (buttons.find((one) => label(one) === label(focused)) ?? buttons[0] ?? title).focus();
}
