// @ts-check
// The buttons of the Lab page: each sends a request, and the next refresh of the page shows the result.
import { api, explain } from "../api.js";
import { cancelConfirmed } from "../confirm.js";
import { byId } from "../dom.js";
import { person } from "../person.js";
import { showSince } from "./since.js";
import { startTour } from "./tour.js";

byId("lab").addEventListener("click", async (/** @type {any} */ event) => {
  const button = event.target.closest("button[data-post], button[data-demonstration]");
  if (!button) return;
  const { number, running } = button.dataset;
  if (running && !(await cancelConfirmed({ number, name: running }))) return;
  button.disabled = true;
  try {
    if (button.dataset.demonstration) await demonstrate(button.dataset.demonstration);
    else await api.post(button.dataset.post, { by: person() });
    byId("lab-refusal").textContent = "";
    document.body.dispatchEvent(new Event("changed"));
  } catch (error) {
    byId("lab-refusal").textContent = explain(error);
  }
  button.disabled = false;
});

/** Queue a template in real time. @param {string} template */
async function demonstrate(template) {
  const { plan } = await api.get(`/templates/${template}`);
  await api.post("/runs", { plan: { ...plan, pace: { kind: "real_time", factor: 1 } }, submitted_by: person() });
}

startTour();
showSince();
