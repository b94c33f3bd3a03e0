// @ts-check
import { api, explain } from "../api.js";
import { byId, el, renew } from "../dom.js";
import { downloadMenu } from "../downloads.js";
import { fixed } from "../format.js";
import { person } from "../person.js";
import { Chosen } from "./chosen.js";
import { Fragility } from "./fragility.js";
import { HeatMap } from "./heat.js";
import { Parallel } from "./parallel.js";
import { Results, titled } from "./results.js";
import { PointTable } from "./table.js";
import { drawTornado } from "./tornado.js";

const POLL_MS = 1500;
const MOST = 20_000; // points that the page loads
const ENDED = ["completed", "cancelled", "failed"];

let sweep = JSON.parse(byId("sweep").textContent ?? "");
const address = `/sweeps/${sweep.id}`;
const results = new Results(sweep.columns);
const complain = (/** @type {unknown} */ error) => (byId("refusal").textContent = explain(error));
const choose = (/** @type {number} */ row) => chosen.add(row);
const filtered = () => draw(false);
const chosen = new Chosen(sweep.id, results);
const heat = new HeatMap(results, choose);
const parallel = new Parallel(results, choose, filtered);
const table = new PointTable(results, choose, filtered);
const fragility = new Fragility(sweep.id, results, complain);
let loaded = -1;

function showState() {
  const state = byId("state");
  state.textContent = sweep.state;
  state.className = `badge ${sweep.state}`;
  byId("reason").hidden = !sweep.reason;
  byId("reason").textContent = sweep.reason ?? "";
  byId("progress").value = sweep.share;
  const counts = [["tripped", sweep.tripped], ["invalid", sweep.invalid], ["failed", sweep.failed]].filter(([, count]) => count);
  const parts = [
    `${sweep.done} of ${sweep.points} points done`,
    ...counts.map(([name, count]) => `${count} ${name}`),
    sweep.elapsed_s !== null && `${fixed(sweep.elapsed_s, 1)} s elapsed`,
    sweep.remaining_s !== null && `about ${fixed(sweep.remaining_s, 0)} s left`,
  ];
  byId("standing").textContent = parts.filter(Boolean).join(" · ");
  byId("partial").textContent = sweep.done < sweep.points ? `The results are partial: ${sweep.done} of ${sweep.points} points.` : "";
  showActions();
}

const downloads = () => downloadMenu([
  ["Report, HTML", `/api/v1${address}/report.html`],
  ["Report, PDF", `/api/v1${address}/report.pdf`],
  ["Results, CSV", `/api/v1${address}/results?format=csv`, true],
  ["Results, Arrow", `/api/v1${address}/results?format=arrow`, true],
]);

function showActions() {
  const does = (/** @type {string} */ what, /** @type {string} */ label, /** @type {string} */ kind) => {
    const button = el("button", { type: "button", class: kind, "data-needs": "engineer", on: { click: () => change(what, button) } }, label);
    return button;
  };
  const link = (/** @type {string} */ href, /** @type {string} */ label) => el("a", { href, class: "button quiet", "data-needs": "engineer" }, label);
  const ended = ENDED.includes(sweep.state);
  renew(
    byId("actions"),
    ...(ended ? [] : [does("cancel", "Cancel this sweep", "danger")]),
    ...(ended && sweep.done < sweep.points ? [does("resume", `Resume the other ${sweep.points - sweep.done} points`, "")] : []),
    ...(sweep.done ? [downloads()] : []),
    link(`/sweeps/new?from=${sweep.id}`, "Edit and sweep again"),
  );
}

/** @param {string} what @param {HTMLButtonElement} button */
async function change(what, button) {
  button.disabled = true;
  try {
    await api.post(`${address}/${what}`, { by: person() });
    byId("refusal").textContent = "";
    await follow();
  } catch (error) {
    complain(error);
    button.disabled = false;
  }
}

/** Offer the measures; the first of the first station is chosen. */
function offerMeasures() {
  const box = byId("measure");
  const measures = results.numbers("measure");
  if (box.options.length === measures.length) return;
  const kept = box.value;
  box.replaceChildren(...measures.map((one) => el("option", { value: one.key }, titled(one))));
  box.value = measures.some(({ key }) => key === kept) ? kept : (measures[0]?.key ?? "");
}

async function loadResults() {
  if (loaded === sweep.done) return;
  const found = await api.get(`${address}/results?limit=${MOST}`);
  results.values = found.values;
  loaded = found.total;
  byId("nothing").hidden = results.size > 0;
  byId("shown").hidden = !results.size;
  if (found.total > MOST) byId("partial").textContent = `The page shows the first ${MOST} of ${found.total} points; the downloads have all.`;
  if (results.size) offerMeasures();
  draw(true);
}

/** Draw all charts, or only those that the filters change. @param {boolean} all */
function draw(all) {
  const measure = byId("measure").value;
  if (!results.size || !measure) return;
  heat.draw(measure);
  parallel.draw(measure);
  table.draw(measure);
  chosen.draw();
  if (!all) return;
  drawTornado(sweep.id, results.column(measure)).catch(complain);
  fragility.draw(measure).catch(complain);
}

let following = 0;

/** Read the progress, and the results where there are more, until the sweep has ended. */
async function follow() {
  clearTimeout(following);
  try {
    sweep = { ...sweep, ...(await api.get(address)) };
    showState();
    await loadResults();
  } catch (error) {
    complain(error);
  }
  if (!ENDED.includes(sweep.state)) following = setTimeout(follow, POLL_MS);
}

byId("measure").addEventListener("change", () => draw(true));
document.addEventListener("themechange", () => draw(true));
showState();
follow();
