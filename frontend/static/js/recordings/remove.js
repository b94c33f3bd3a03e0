// @ts-check
import { api, explain } from "../api.js";
import { byId } from "../dom.js";

/** Buttons with `data-remove` delete that recording after a confirmation. Errors appear in #refusal. @param {() => void} removed */
export function removal(removed) {
  for (const button of /** @type {NodeListOf<HTMLButtonElement>} */ (document.querySelectorAll("[data-remove]"))) {
    button.addEventListener("click", async () => {
      if (!confirm(`Delete the recording ${button.dataset.name}? You cannot undo this.`)) return;
      try {
        await api.remove(`/recordings/${button.dataset.remove}`);
        removed();
      } catch (error) {
        byId("refusal").textContent = explain(error);
      }
    });
  }
}
