// @ts-check
import { api, explain } from "../api.js";
import { cancelConfirmed } from "../confirm.js";
import { controlLine } from "../control/line.js";
import { UNKNOWN } from "../control/withheld.js";
import { byId, renew } from "../dom.js";
import { person } from "../person.js";
import { loading } from "../ready.js";
import { actions, cancelling } from "./actions.js";
import { Annotations } from "./annotations.js";
import { again } from "./again.js";
import { buildCharts } from "./charts.js";
import { showClient } from "./client.js";
import { Deadlines } from "./deadlines.js";
import { awaited, clock, ended, facts, reason } from "./facts.js";
import { follow } from "./live.js";
import { floorCount, metricsTables } from "./metrics.js";
import { printsAll } from "./printing.js";
import { Stage } from "./stage.js";
import { Store } from "./store.js";
import { Transport } from "./transport.js";
import { View } from "./view.js";

const POLL_MS = 2000;
const id = byId("run").dataset.id;

/** @type {any} */
let run = null;
/** @type {any} */
let paper = null;
/** @type {{measures: import("./measures.js").Measure[], channels: Record<string, any>}} */
let declared = { measures: [], channels: {} };
/** @type {{store: Store, view: View, transport: Transport, tiles: import("./tiles.js").Tiles} | null} */
let shown = null;
let attempt = 0;
let control = UNKNOWN;
/** @type {Deadlines | null} */
let deadlines = null;
/** @type {Annotations | null} */
let annotations = null;
/** Fulfilled once the live feed has shown the test, has said that it waits, or is lost. @type {PromiseWithResolvers<void>} */
const seen = Promise.withResolvers();

async function load() {
  [run, control] = await Promise.all([api.get(`/runs/${id}`), api.get(`/control?by=${encodeURIComponent(person())}`)]);
  if (run.template?.startsWith("table3-")) paper ??= (await api.get(`/templates/${run.template}`)).paper;
  show();
}

function show() {
  const state = byId("state");
  state.textContent = run.state;
  state.className = `badge ${run.state}`;
  document.title = `${run.state === "running" ? "▶ " : ""}#${run.number} ${run.name} · RTHS control room`;
  const why = reason(run);
  const banner = byId("reason");
  banner.hidden = !why;
  banner.textContent = why ?? "";
  banner.classList.toggle("bad", run.state !== "cancelled");
  const waiting = document.getElementById("waiting");
  if (waiting) waiting.textContent = awaited(run);
  showClient(byId("client"), run.client);
  renew(byId("facts"), ...facts(run, declared.measures));
  showProgress(run);
  showDeadlines(run.timing);
  showActions();
  showEnd();
  const measured = ended(run.state) && (run.recording || run.recording_removed_at) && (run.stations?.length || floorCount(run, declared.measures));
  byId("metrics").hidden = !measured;
  if (measured) {
    showTiles();
    byId("metrics").replaceChildren(...metricsTables(run, paper, declared.measures));
  }
}

/** Tell the view whether the test has ended, and why. */
function showEnd() {
  if (!shown) return;
  shown.view.ended = ended(run.state);
  shown.view.trip = run.trip;
  shown.transport.show();
  shown.view.redraw();
}

function showTiles() {
  shown?.tiles.show(run);
  if (run.stations.length) shown?.tiles.fold();
}

/** @param {any} at */
function showProgress(at) {
  const { simulated_s = 0 } = at;
  const duration_s = run.test === "client" ? null : (at.duration_s ?? 0);
  byId("clock").hidden = ended(at.state) && simulated_s === null;
  const waits = at.state === "queued" ? "Waiting in the queue" : at.state === "to approve" ? "Waiting for approval" : at.client?.state === "waiting" && !ended(at.state) ? "Waiting for client" : "";
  byId("clock").textContent = waits || clock({ ...at, simulated_s, duration_s });
}

/** The deadlines of a test in real time, of the whole test or so far. @param {import("./deadlines.js").Timing | null | undefined} timing */
function showDeadlines(timing) {
  const host = byId("deadlines");
  host.hidden = ended(run.state) || run.test === "client" ? !timing : run.plan?.pace?.kind !== "real_time"; // a client sets the time of its steps
  if (host.hidden) return;
  deadlines ??= new Deadlines(host);
  if (timing) deadlines.show(timing);
}

function showActions() {
  renew(byId("actions"), ...actions(run));
  const refusal = control.refusals[run.rig_id];
  const refused = (/** @type {string} */ reason) => (byId("refusal").textContent = reason);
  renew(byId("stop"), ...cancelling(run, stop, refusal), ...again(run, control.approvals ? undefined : refusal, refused, () => location.reload()));
}

/** @param {HTMLButtonElement} button */
async function stop(button) {
  if (run.state === "running" && !(await cancelConfirmed(run))) return;
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

/** Build the page of an attempt. @param {import("./store.js").Schema} schema */
function build(schema) {
  shown?.view.close();
  shown?.transport.close();
  const store = new Store(schema);
  const view = new View(store);
  new Stage(byId("stage"), view, run.plan, declared.channels);
  const tiles = buildCharts(byId("charts"), view, run.plan, declared);
  shown = { store, view, tiles, transport: new Transport(view) };
  if (ended(run.state)) showTiles();
  annotations?.show();
  showEnd();
}

/** @type {import("./live.js").Viewer} */
const viewer = {
  received: () => shown?.store.count ?? 0,
  schema(schema) {
    const states = run.state;
    run = { ...run, ...schema.run };
    if (attempt !== schema.attempt || shown?.store.buckets !== schema.buckets) {
      attempt = schema.attempt;
      build(schema);
    }
    if (run.state !== states) show();
  },
  frame(frame) {
    if (!shown?.store.take(frame)) return false;
    shown.view.redraw();
    shown.transport.show();
    if (!ended(run.state)) seen.resolve(); // of a test that has ended, the end follows
    return true;
  },
  progress(progress) {
    if (progress.state !== run.state) {
      run.state = progress.state;
      show();
    }
    Object.assign(run, progress);
    showProgress(progress);
    if (progress.client) showClient(byId("client"), progress.client);
    if (!ended(run.state)) seen.resolve();
    if (progress.measures) shown?.tiles.show(progress.measures);
    if (progress.timing) showDeadlines(progress.timing);
  },
  end(last) {
    run = { ...run, ...last };
    load().catch(complain).finally(seen.resolve);
  },
  link(state, why) {
    if (state !== "open") seen.resolve();
    const told = { open: "", reconnecting: "Connection lost, reconnecting …", refused: why && `No live data: ${why}` };
    byId("link").textContent = told[state];
  },
};

/** @param {unknown} error */
const complain = (error) => (byId("refusal").textContent = explain(error));

/** @param {string} state */
const waits = (state) => state === "queued" || state === "to approve";

/** Poll the status of a queued run until the live feed reports it. */
async function poll() {
  if (waits(run.state)) await load().catch(complain);
  if (waits(run.state)) setTimeout(poll, POLL_MS);
}

document.addEventListener("themechange", () => shown?.view.redraw());
document.addEventListener("aborted", () => load().catch(complain));
if (matchMedia("(max-width: 700px)").matches) byId("facts-fold").open = false;
printsAll(() => shown?.view.drawAll());

try {
  declared = await api.get("/schema");
  await load();
  annotations = new Annotations(byId("annotations"), run, () => shown?.view);
  await annotations.load();
  if (!ended(run.state) || run.recording) {
    follow(id, viewer);
    void loading(seen.promise);
  }
  poll();
  const told = (/** @type {import("../control/withheld.js").Control} */ said) => {
    const before = control.refusals[run.rig_id];
    control = said;
    if (control.refusals[run.rig_id] !== before) showActions();
  };
  if (!ended(run.state)) controlLine(byId("control"), (rig) => rig.rig_id === run.rig_id, { told });
} catch (error) {
  complain(error);
}
