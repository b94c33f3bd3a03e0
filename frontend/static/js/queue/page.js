// @ts-check
// The page of the queue: it shows what the service says every 1.5 s, and at once after each change.
import { api, explain } from "../api.js";
import { controlLine } from "../control/line.js";
import { UNKNOWN, withhold } from "../control/withheld.js";
import { byId, el, renew } from "../dom.js";
import { person } from "../person.js";
import { toast } from "../toast.js";
import { draggable } from "./drag.js";
import { holding } from "./hold.js";
import { showRunning } from "./running.js";
import { WaitingRow } from "./waiting.js";
import { counted, span } from "./words.js";

const PERIOD_MS = 1500;
/** @type {Map<string, WaitingRow>} */
const rows = new Map();
/** @type {import("./waiting.js").Waiting[]} */
let line = [];
let control = UNKNOWN;
/** @type {any} */
let latest = null;
let dragged = "";
let timer = 0;
const body = byId("waiting-rows");

const acts = {
  /** @param {string} id */ up: (id) => step(id, -1),
  /** @param {string} id */ down: (id) => step(id, 1),
  /** @param {string} id */ top: (id) => move([id], { to: "top" }),
  /** @param {string} id */ cancel: (id) => cancel([id]),
  /** @param {string} id @param {number} priority */
  priority: (id, priority) => prioritise([id], priority),
  select: bulk,
};

/** @param {string} id @param {number} by */
function step(id, by) {
  const neighbour = line[line.findIndex((one) => one.id === id) + by]?.id;
  if (neighbour) move([id], by < 0 ? { before: neighbour } : { after: neighbour });
}

/** @param {string[]} runs @param {object} place */
const move = (runs, place) => change("/queue/order", { runs, ...place, by: person() });

/** @param {string[]} runs @param {number} priority */
const prioritise = (runs, priority) => change("/queue/priority", { runs, priority, by: person() });

/** Send a change; its answer is the new queue. @param {string} path @param {object} data */
async function change(path, data) {
  try {
    show(await api.post(path, data));
    refused("");
  } catch (error) {
    refused(explain(error));
    refresh();
  }
}

/** @param {string[]} runs */
async function cancel(runs) {
  try {
    const { cancelled, refused: left } = await api.post("/queue/cancel", { runs, by: person() });
    refused(left.map((/** @type {any} */ one) => one.reason).join(" "));
    const undo = el("button", { type: "button", class: "small" }, "Undo the cancel");
    const note = toast(`${counted(cancelled.length, "test")} cancelled.`, { more: cancelled.length ? [undo] : [] });
    undo.addEventListener("click", () => {
      note.remove();
      restore(cancelled);
    });
  } catch (error) {
    refused(explain(error));
  }
  refresh();
}

/** Undo cancels of tests that had not started. @param {string[]} runs */
async function restore(runs) {
  try {
    for (const run of runs) await api.post(`/runs/${run}/undo-cancel`, { by: person() });
    refused("");
  } catch (error) {
    refused(explain(error));
  }
  refresh();
}

/** @param {string} reason */
const refused = (reason) => (byId("refusal").textContent = reason);
const selected = () => line.map((one) => one.id).filter((id) => rows.get(id)?.check.checked);

function bulk() {
  const count = selected().length;
  byId("bulk").hidden = !count;
  byId("bulk-count").textContent = `${counted(count, "test")} selected`;
  const all = byId("select-all");
  all.checked = count > 0 && count === line.length;
  all.indeterminate = count > 0 && count < line.length;
  const why = line.filter(({ id }) => rows.get(id)?.check.checked).map(({ rig_id }) => control.refusals[rig_id]).find(Boolean);
  for (const id of ["bulk-top", "bulk-priority", "bulk-cancel"]) withhold(byId(id), why);
}

/** @param {any} queue */
function show(queue) {
  latest = queue;
  holding(queue, change, control);
  const cancelOne = async (/** @type {string} */ id) => {
    await api.post(`/runs/${id}/cancel`, { by: person() }).catch((error) => refused(explain(error)));
    refresh();
  };
  showRunning(queue.running, cancelOne, control.refusals);
  byId("summary").textContent = summary(queue);
  byId("worker-down").hidden = queue.worker_alive;
  if (!dragged) showWaiting(queue);
  showUndo(queue.undoable);
}

/** @param {any} queue */
function summary(queue) {
  const rest = queue.queued && queue.total_s != null && !queue.held ? `, all done in ${span(queue.total_s)}` : "";
  return `${queue.running.length} running, ${queue.queued} waiting${rest}. Up to ${counted(queue.tests_at_a_time, "test")} at a time.`;
}

/** @param {any} queue */
function showWaiting(queue) {
  line = queue.waiting;
  byId("waiting-table").hidden = !line.length;
  byId("waiting-none").hidden = line.length > 0;
  byId("waiting-more").textContent = queue.queued > line.length ? `${queue.queued - line.length} more tests wait.` : "";
  const present = new Set(line.map((one) => one.id));
  for (const [id, row] of rows) {
    if (present.has(id)) continue;
    row.node.remove();
    rows.delete(id);
  }
  const focused = /** @type {any} */ (document.activeElement);
  line.forEach((one, index) => {
    const row = rows.get(one.id) ?? new WaitingRow(one, acts);
    rows.set(one.id, row);
    row.update(one, index === line.length - 1, control.refusals[one.rig_id]);
    if (body.children[index] !== row.node) body.insertBefore(row.node, body.children[index] ?? null);
  });
  if (focused && body.contains(focused) && document.activeElement !== focused) focused.focus();
  bulk();
}

/** @param {any[]} undoable */
function showUndo(undoable) {
  byId("undo").hidden = !undoable.length;
  const refusals = control.approvals ? {} : control.refusals; // what waits for approval needs no driver
  const items = undoable.map((one) =>
    el(
      "li",
      {},
      el("span", {}, el("a", { href: `/runs/${one.id}` }, `Run ${one.number}, ${one.name}`), `: ${one.reason}`),
      el(
        "button",
        {
          type: "button",
          class: "quiet small",
          ...{ "data-needs": "operator", "data-undo": one.id },
          "aria-label": `Undo the cancel of run ${one.number}`,
          disabled: one.rig_id in refusals,
          title: refusals[one.rig_id],
        },
        "Undo the cancel",
      ),
    ),
  );
  renew(byId("undo-list"), ...items);
}

async function refresh() {
  clearTimeout(timer);
  try {
    show(await api.get("/queue"));
  } catch (error) {
    refused(explain(error));
  }
  timer = setTimeout(refresh, PERIOD_MS);
}

draggable(body, {
  begin: (id) => (dragged = id),
  end: () => (dragged = ""),
  drop: (place) => {
    const chosen = selected();
    const runs = chosen.includes(dragged) ? chosen : [dragged];
    const anchor = place.before ?? place.after ?? "";
    dragged = "";
    if (!runs.includes(anchor)) move(runs, place);
  },
});
byId("select-all").addEventListener("change", (/** @type {any} */ event) => {
  for (const row of rows.values()) row.check.checked = event.target.checked;
  bulk();
});
byId("bulk-top").addEventListener("click", () => move(selected(), { to: "top" }));
byId("bulk-cancel").addEventListener("click", () => cancel(selected()));
byId("bulk-priority").addEventListener("change", (/** @type {any} */ event) => {
  prioritise(selected(), Number(event.target.value));
  event.target.value = "";
});
byId("undo-list").addEventListener("click", (/** @type {any} */ event) => {
  const button = event.target.closest("[data-undo]");
  if (button) restore([button.dataset.undo]);
});
refresh();
const shown = (/** @type {any} */ rig) => Boolean(rig.driver) || line.some((one) => one.rig_id === rig.rig_id) || rig.rig_id === "emulated";
controlLine(byId("control"), shown, {
  told: (said) => {
    control = said;
    if (latest) show(latest);
  },
});
