// @ts-check
// The bar on every page while a test runs. Abort asks for a second press, then stops all tests and holds the queue.
import { api, explain } from "./api.js";
import { byId, el, renew } from "./dom.js";
import { person } from "./person.js";

const PERIOD_MS = 1500;
const CONFIRM_MS = 5000;
const bar = byId("abort");

const names = el("span", { class: "running" });
const note = el("span", { class: "note", role: "status" });
const button = el("button", { type: "button", class: "danger", "aria-describedby": "abort-words" }, "Abort");
const words = el(
  "span",
  { id: "abort-words", class: "words" },
  "Abort stops the tests of this program and holds the queue. It is NOT the laboratory's emergency stop.",
);
bar.append(names, words, note, button);

let armed = 0;

function disarm() {
  clearTimeout(armed);
  armed = 0;
  button.textContent = "Abort";
  button.classList.remove("armed");
}

button.addEventListener("click", async () => {
  if (!armed) {
    button.textContent = "Press again to abort";
    button.classList.add("armed");
    armed = setTimeout(disarm, CONFIRM_MS);
    return;
  }
  disarm();
  note.textContent = "Stopping …";
  try {
    await api.post("/abort", { by: person() });
    note.textContent = "Stopped. The queue is held: release it on the page Queue.";
    document.dispatchEvent(new Event("aborted"));
  } catch (error) {
    note.textContent = `Not stopped: ${explain(error)}`;
  }
});
button.addEventListener("blur", disarm);
button.addEventListener("keydown", (/** @type {KeyboardEvent} */ event) => event.key === "Escape" && disarm());

async function refresh() {
  try {
    const { runs, total } = await api.get("/runs?state=running&limit=5");
    if (total) {
      if (bar.hidden) note.textContent = "";
      renew(names, "Running: ", ...runs.map(link).flatMap((/** @type {Node} */ a, /** @type {number} */ i) => (i ? [", ", a] : [a])));
      bar.hidden = false;
    } else {
      bar.hidden = !note.textContent.startsWith("Stopped") || bar.hidden;
      if (!bar.hidden) names.textContent = "No test is running. ";
    }
    button.disabled = !total;
  } catch (error) {
    note.textContent = bar.hidden ? "" : explain(error);
  }
  setTimeout(refresh, PERIOD_MS);
}

/** @param {{id: string, number: number, name: string}} run */
const link = (run) => el("a", { href: `/runs/${run.id}`, title: run.name }, `#${run.number} ${run.name}`);

refresh();
