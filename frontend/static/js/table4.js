// @ts-check
// Queues the twelve simulations; the next refresh of the page shows them.
import { api, explain } from "./api.js";
import { byId } from "./dom.js";
import { person } from "./person.js";

const button = /** @type {HTMLButtonElement} */ (byId("queue-all"));

button.addEventListener("click", async () => {
  button.disabled = true;
  try {
    await api.post("/table4", { by: person() });
    byId("refusal").textContent = "";
    document.body.dispatchEvent(new Event("changed"));
  } catch (error) {
    byId("refusal").textContent = explain(error);
  }
  button.disabled = false;
});
