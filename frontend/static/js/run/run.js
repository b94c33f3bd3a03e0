// @ts-check
import { api, explain } from "../api.js";
import { byId, el, renew } from "../dom.js";
import { person } from "../person.js";
import { buildCharts } from "./charts.js";
import { clock, ended, facts, reason } from "./facts.js";
import { follow } from "./live.js";
import { floorCount, metricsTables } from "./metrics.js";
import { Store } from "./store.js";

const POLL_MS = 2000;
const id = byId("run").dataset.id;

/** @type {any} */
let run = null;
/** @type {any} */
let paper = null;
/** @type {{measures: import("./measures.js").Measure[], channels: Record<string, any>}} */
let declared = { measures: [], channels: {} };
/** @type {Store | null} */
let store = null;
/** @type {import("./view.js").View | null} */
let view = null;
/** @type {import("./tiles.js").Tiles | null} */
let tiles = null;
let attempt = 0;

async function load() {
  run = await api.get(`/runs/${id}`);
  if (run.template?.startsWith("table3-")) paper ??= (await api.get(`/templates/${run.template}`)).paper;
  show();
}

function show() {
  const state = byId("state");
  state.textContent = run.state;
  state.className = `badge ${run.state}`;
  document.title = `${run.state === "running" ? "▶ " : ""}${run.name} · RTHS control room`;
  const why = reason(run);
  const banner = byId("reason");
  banner.hidden = !why;
  banner.textContent = why ?? "";
  banner.classList.toggle("bad", run.state !== "cancelled");
  renew(byId("facts"), ...facts(run, declared.measures));
  showProgress(run);
  showActions();
  const measured = ended(run.state) && run.recording && (run.stations?.length || floorCount(run, declared.measures));
  byId("metrics").hidden = !measured;
  if (measured) {
    showTiles();
    byId("metrics").replaceChildren(...metricsTables(run, paper, declared.measures));
  }
}

function showTiles() {
  tiles?.show(run);
  if (run.stations.length) tiles?.fold();
}

/** @param {any} at */
function showProgress(at) {
  const { simulated_s = 0, duration_s = 0 } = at;
  byId("advance").hidden = ended(at.state) && simulated_s === null;
  byId("progress").value = duration_s ? simulated_s / duration_s : 0;
  byId("clock").textContent = at.state === "queued" ? "Waiting in the queue" : clock({ ...at, simulated_s, duration_s });
}

function showActions() {
  const download = (/** @type {string} */ file, /** @type {string} */ label) =>
    el("a", { href: `/api/v1/runs/${id}/${file}`, class: "button quiet", ...(file === "report.html" ? {} : { download: true }) }, label);
  const cancel = el("button", { type: "button", class: "danger", on: { click: () => stop(cancel) } }, "Cancel this test");
  renew(
    byId("actions"),
    ...(ended(run.state) ? [] : [cancel]),
    ...(run.recording
      ? [download("recording.h5", "Recording, HDF5"), download("recording.csv", "Recording, CSV"), download("measures.csv", "Measures, CSV"), download("report.html", "Report")]
      : []),
    download("plan.yaml", "Plan, YAML"),
    ...(run.test === "specimen" || run.test === "actuator" ? [] : [el("a", { href: `/stability/${id}`, class: "button quiet" }, "Stability")]),
    ...(run.recording ? [el("a", { href: `/diagnoses?run=${id}`, class: "button quiet" }, "Diagnose this run")] : []),
    el("a", { href: `/new?from=${id}`, class: "button quiet" }, "Edit and run again"),
  );
}

/** @param {HTMLButtonElement} button */
async function stop(button) {
  button.disabled = true;
  button.textContent = "Stopping …";
  try {
    await api.post(`/runs/${id}/cancel`, { by: person() });
    byId("refusal").textContent = "";
    await load();
  } catch (error) {
    byId("refusal").textContent = `Not cancelled: ${explain(error)}`;
    showActions();
  }
}

/** @type {import("./live.js").Viewer} */
const viewer = {
  received: () => store?.count ?? 0,
  schema(schema) {
    const states = run.state;
    run = { ...run, ...schema.run };
    if (!store || attempt !== schema.attempt || store.buckets !== schema.buckets) {
      attempt = schema.attempt;
      store = new Store(schema);
      view?.close();
      ({ view, tiles } = buildCharts(byId("charts"), store, run.plan, declared));
      byId("chart-controls").hidden = false;
      if (ended(run.state)) showTiles();
      showWindow();
    }
    if (run.state !== states) show();
  },
  frame(frame) {
    if (!store?.take(frame)) return false;
    view?.redraw();
    return true;
  },
  progress(progress) {
    if (progress.state !== run.state) {
      run.state = progress.state;
      show();
    }
    Object.assign(run, progress);
    showProgress(progress);
    if (progress.measures) tiles?.show(progress.measures);
  },
  end(last) {
    run = { ...run, ...last };
    load().catch(complain);
  },
  link(state, why) {
    const told = { open: "", reconnecting: "Connection lost, reconnecting …", refused: why && `No live data: ${why}` };
    byId("link").textContent = told[state];
  },
};

/** @param {unknown} error */
const complain = (error) => (byId("refusal").textContent = explain(error));

/** Poll the status of a queued run until the live feed reports it. */
async function poll() {
  if (run.state === "queued") await load().catch(complain);
  if (run.state === "queued") setTimeout(poll, POLL_MS);
}

function showWindow() {
  if (!view) return;
  view.window = Number(byId("window").value) || null;
  view.zoomTo(null);
}

byId("window").addEventListener("change", showWindow);
byId("reset").addEventListener("click", () => view?.zoomTo(null));
document.addEventListener("themechange", () => view?.redraw());
document.addEventListener("aborted", () => load().catch(complain));

try {
  declared = await api.get("/schema");
  await load();
  if (!ended(run.state) || run.recording) follow(id, viewer);
  poll();
} catch (error) {
  complain(error);
}
