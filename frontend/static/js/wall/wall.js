// @ts-check
import { ApiError, api } from "../api.js";
import { controlLine } from "../control/line.js";
import { byId, el, renew } from "../dom.js";
import { ended } from "../run/facts.js";
import { Display } from "./display.js";
import { nextTests, stateOf } from "./words.js";

const POLL_MS = 2000;
const MOST_TESTS = 4; // side by side

const only = document.body.dataset.run ?? "";
const host = byId("wall-tests");
/** @type {Map<string, Display>} */
const displays = new Map();
/** @type {Record<string, any> | null} */
let declared = null;
let answered = new Date();

/** The runs to show: the one of the address, the running ones, or between tests the last one. @param {any} queue @returns {Promise<any[]>} */
async function wanted(queue) {
  if (only) return [await api.get(`/runs/${only}`)];
  if (queue.running.length) return queue.running.slice(0, MOST_TESTS);
  const ran = "/runs?state=completed&state=tripped&state=cancelled&sort=finished_at&limit=1";
  return (await api.get(ran)).runs;
}

/** @param {any[]} runs */
async function show(runs) {
  const alone = runs.length === 1;
  for (const [id, one] of displays) {
    if (one.alone === alone && runs.some((run) => run.id === id)) continue;
    one.close();
    displays.delete(id);
  }
  for (const run of runs) if (!displays.has(run.id)) displays.set(run.id, new Display(await api.get(`/runs/${run.id}`), declared ?? {}, alone));
  for (const run of runs) displays.get(run.id)?.state(run);
  host.dataset.tests = String(runs.length);
  const empty = el("p", { class: "wall-empty" }, "No test has run yet. The next test appears here when it starts.");
  renew(host, ...(runs.length ? runs.map((run) => /** @type {Display} */ (displays.get(run.id)).element) : [empty]));
}

async function look() {
  try {
    declared ??= (await api.get("/schema")).channels;
    const queue = await api.get("/queue?limit=20");
    const runs = await wanted(queue);
    await show(runs);
    answered = new Date();
    const state = stateOf(queue, only ? runs : queue.running);
    byId("wall-state").textContent = state.words;
    document.body.dataset.state = state.name;
    byId("wall-next").textContent = nextTests(queue, queue.running.length - MOST_TESTS);
  } catch (error) {
    const lost = error instanceof ApiError && error.status === 401 ? "Signed out" : "No answer from the control room";
    byId("wall-state").textContent = `${lost} since ${answered.toLocaleTimeString()}`;
    document.body.dataset.state = "lost";
  }
  setTimeout(look, only && displays.size && [...displays.values()].every((one) => ended(one.run.state)) ? 5 * POLL_MS : POLL_MS);
}

function tick() {
  byId("wall-clock").textContent = new Date().toTimeString().slice(0, 8);
  setTimeout(tick, 1000 - (Date.now() % 1000));
}

/** Keep the screen on where the browser allows it. */
async function stayAwake() {
  if (document.visibilityState === "visible") await navigator.wakeLock?.request("screen").catch(() => null);
}

document.addEventListener("visibilitychange", stayAwake);
stayAwake();
tick();
look();
controlLine(byId("control"), (rig) => Boolean(rig.driver), { controls: false });
