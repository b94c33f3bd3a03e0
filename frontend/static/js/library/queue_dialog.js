// @ts-check
import { api, explain } from "../api.js";
import { byId, el } from "../dom.js";
import { significant } from "../format.js";
import { person, remember } from "../person.js";

/**
 * What the dry run of a plan says.
 * @typedef {{name: string, label: string, against: string, against_label: string, peak: number | null, bound: number, share: number | null, shown_label: string, factor: number}} Use
 * @typedef {{verdict: string, sentence: string, uses: Use[], duration_s: number, expected_elapsed_s: number | null, notes: string[]}} Preflight
 */

const SHOWN = 4; // largest shares of limits
const LEAST = 0.01; // share that is worth a line

const dialog = byId("queue-dialog");
const who = byId("queue-who");
const rig = byId("queue-rig");
const found = byId("queue-preflight");
const wrong = byId("queue-wrong");
const queue = byId("queue-now");
/** @type {{plan: any, library: {id: string, version: number}}} */
let asked;
let asking = new AbortController();

/** Show what a version would do, and queue it. @param {string} id @param {string} name @param {number} version */
export async function queueVersion(id, name, version) {
  const [{ plan }, { rigs }] = await Promise.all([api.get(`/library/plans/${id}/versions/${version}`), api.get("/rigs")]);
  offerRigs(rigs.filter((/** @type {{retired: boolean}} */ { retired }) => !retired));
  asked = { plan, library: { id, version } };
  byId("queue-what").textContent = `${name}, version ${version}`;
  who.value = person();
  wrong.textContent = "";
  dialog.showModal();
  queue.focus();
  await foresee();
}

/** @param {{id: string, name: string}[]} rigs */
function offerRigs(rigs) {
  rig.replaceChildren(...rigs.map(({ id, name }) => el("option", { value: id }, name)));
  byId("queue-rig-field").hidden = rigs.length < 2;
}

async function foresee() {
  asking.abort();
  const { signal } = (asking = new AbortController());
  queue.textContent = "Queue the test";
  queue.disabled = false;
  found.replaceChildren(el("p", { class: "muted", "aria-busy": "true" }, "Simulating the test …"));
  try {
    const seen = await api.post("/plans/preflight", { plan: asked.plan, rig: rig.value }, signal);
    found.replaceChildren(...outlook(seen));
    if (seen.verdict === "trips") queue.textContent = "Queue the test although it would trip";
    queue.disabled = seen.verdict === "refused"; // another rig may take it
  } catch (error) {
    if (!signal.aborted) found.replaceChildren(el("p", { class: "note bad" }, `No preflight: ${explain(error)}`));
  }
}

/** @param {Preflight} seen */
function outlook({ verdict, sentence, uses, notes }) {
  const limits = uses.filter((one) => one.against !== "actuator" && (one.share ?? 0) >= LEAST);
  limits.sort((a, b) => (b.share ?? 0) - (a.share ?? 0));
  const parts = limits.slice(0, SHOWN).flatMap(({ name, label, against, against_label, peak, bound, factor, shown_label, share }) => [
    el("dt", {}, `${name}: ${label}${against === "rig" ? `, ${against_label}` : ""}`),
    el("dd", {}, `${significant((peak ?? 0) / factor)} of ${significant(bound / factor)} ${shown_label} (${significant(100 * (share ?? 0), 2)} %)`),
  ]);
  return [
    el("p", { class: { completes: "good", trips: "note bad", refused: "note bad" }[verdict] ?? "note" }, sentence),
    parts.length > 0 && el("p", { class: "muted" }, "Largest shares of limits and capacities"),
    parts.length > 0 && el("dl", { class: "shares" }, ...parts),
    ...notes.map((note) => el("p", { class: "muted" }, note)),
  ].filter((one) => one !== false);
}

/** @param {Event} event */
async function submit(event) {
  event.preventDefault();
  const name = who.value.trim();
  if (!name) {
    wrong.textContent = "Give your name: it is stored with the run. This browser remembers it.";
    return who.focus();
  }
  remember(name);
  queue.disabled = true;
  try {
    const { runs } = await api.post("/runs", { ...asked, rig: rig.value, submitted_by: name });
    location.assign(`/runs/${runs[0].id}`);
  } catch (error) {
    wrong.textContent = explain(error);
  } finally {
    queue.disabled = false;
  }
}

dialog.querySelector("form").addEventListener("submit", submit);
rig.addEventListener("change", foresee);
dialog.addEventListener("close", () => asking.abort());
byId("queue-cancel").addEventListener("click", () => dialog.close());
