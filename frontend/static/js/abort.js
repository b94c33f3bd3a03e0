// @ts-check
// The bar on every page while a test runs, or while the service does not say whether one runs. Abort asks for a second press,
// then stops all tests and holds the queue; the bar says which workers have acknowledged and whether the hold is recorded.
import { ApiError, api, explain } from "./api.js";
import { byId, el, renew } from "./dom.js";
import { person } from "./person.js";
import { may } from "./role.js";
import { signInLink } from "./signed_out.js";

const PERIOD_MS = 1500;
const CONFIRM_MS = 5000;
const PATIENCE_MS = 4000;
const FOLLOW_MS = 250;
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
let following = false;

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
    await follow(await api.post("/abort", { by: person() }));
    document.dispatchEvent(new Event("aborted"));
  } catch (error) {
    following = false;
    if (signedOut(error)) renew(note, "Not acknowledged: you are signed out. ", signInLink("Sign in"), ", then press Abort again.");
    else note.textContent = `Not acknowledged: ${explain(error)} Press Abort again.`;
  }
});

/**
 * Show what is known until every worker has acknowledged, no test runs, and the hold is recorded.
 * @param {{held: boolean, acknowledged: boolean, recorded: boolean, running: string[], sentence: string}} known
 */
async function follow(known) {
  following = true;
  while (known.held) {
    note.textContent = known.sentence;
    if (known.acknowledged && known.recorded && !known.running.length) {
      note.textContent = `${known.sentence} ${may("operator") ? "Release it" : "An operator releases it"} on the page Queue.`;
      return;
    }
    await new Promise((wake) => setTimeout(wake, FOLLOW_MS));
    known = await api.get("/abort", AbortSignal.timeout(PATIENCE_MS));
  }
  following = false;
  note.textContent = known.sentence;
}

button.addEventListener("blur", disarm);
button.addEventListener("keydown", (/** @type {KeyboardEvent} */ event) => event.key === "Escape" && disarm());

async function refresh() {
  try {
    const { runs, total } = await api.get("/runs?state=running&limit=5", AbortSignal.timeout(PATIENCE_MS));
    if (total) {
      if (bar.hidden || !following) note.textContent = "";
      renew(names, "Running: ", ...runs.map(link).flatMap((/** @type {Node} */ a, /** @type {number} */ i) => (i ? [", ", a] : [a])));
      bar.hidden = false;
    } else {
      bar.hidden = !following || bar.hidden;
      if (!bar.hidden) names.textContent = "No test is running. ";
    }
    button.disabled = !total;
  } catch (error) {
    names.textContent = "Whether a test runs is not known. ";
    if (signedOut(error)) renew(note, "You are signed out: ", signInLink("Sign in to abort"));
    else if (!following) note.textContent = explain(error);
    bar.hidden = button.disabled = false;
  }
  setTimeout(refresh, PERIOD_MS);
}

/** @param {unknown} error */
const signedOut = (error) => error instanceof ApiError && error.status === 401;

/** @param {{id: string, number: number, name: string}} run */
const link = (run) => el("a", { href: `/runs/${run.id}`, title: run.name }, `#${run.number} ${run.name}`);

refresh();
