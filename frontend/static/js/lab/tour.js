// @ts-check
import { byId } from "../dom.js";

const KEY = "rths.tour";

/** Show the tour until a person hides it. The state is on the root element: the page is renewed around it. */
export function startTour() {
  const root = document.documentElement;
  root.dataset.tour = localStorage.getItem(KEY) ?? "shown";
  document.addEventListener("click", (/** @type {any} */ event) => {
    const button = event.target.closest("button[data-tour]");
    if (!button) return;
    root.dataset.tour = button.dataset.tour;
    localStorage.setItem(KEY, button.dataset.tour);
    byId(button.dataset.tour === "shown" ? "tour-hide" : "tour-show").focus();
  });
}
