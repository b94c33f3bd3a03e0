// @ts-check
import { api, explain } from "../api.js";
import { byId } from "../dom.js";
import { person } from "../person.js";
import { ended } from "../run/facts.js";

const POLL_MS = 700;
const { id, name, state } = byId("diagnosis").dataset;

/** @param {unknown} error */
const complain = (error) => (byId("refusal").textContent = explain(error));

/** Send a request when a button is pressed. After an error the button can be pressed again. @param {string} button @param {() => Promise<any>} ask */
function asks(button, ask) {
  const found = /** @type {HTMLButtonElement | null} */ (document.getElementById(button));
  found?.addEventListener("click", async () => {
    found.disabled = true;
    try {
      await ask();
      byId("refusal").textContent = "";
    } catch (error) {
      complain(error);
      found.disabled = false;
    }
  });
}

/** Poll until `over` is true, then reload the page. @param {() => Promise<boolean>} over */
async function until(over) {
  try {
    if (await over()) return location.reload();
  } catch (error) {
    complain(error);
  }
  setTimeout(() => until(over), POLL_MS);
}

async function progressed() {
  const now = await api.get(`/diagnoses/${id}`);
  byId("progress").value = now.share;
  const percent = `${Math.round(100 * now.share)} %`;
  byId("doing").textContent = now.state === "queued" ? "Waiting in the queue" : [percent, now.doing].filter(Boolean).join(", ");
  byId("refusal").textContent = "";
  return ended(now.state);
}

const runs = [...document.querySelectorAll("#simulations [data-run]")].map((item) => /** @type {HTMLElement} */ (item).dataset.run);
const waiting = document.querySelectorAll("#simulations .queued, #simulations .running").length > 0;

async function simulated() {
  const now = await Promise.all(runs.map((run) => api.get(`/runs/${run}`)));
  return now.every((run) => ended(run.state));
}

asks("cancel", () => api.post(`/diagnoses/${id}/cancel`, { by: person() }));
asks("simulate", async () => {
  await api.post(`/diagnoses/${id}/simulations`, { by: person() });
  location.reload();
});
asks("remove", async () => {
  if (!confirm(`Delete the diagnosis ${name}? You cannot undo this.`)) throw new Error("");
  await api.remove(`/diagnoses/${id}`);
  location.assign("/diagnoses");
});

if (!ended(String(state))) until(progressed);
else if (waiting) until(simulated);
