// @ts-check
// The running tests: progress, rig, expected end, and a cancel that asks first.
import { cancelConfirmed } from "../confirm.js";
import { byId, el, renew } from "../dom.js";
import { clock } from "./words.js";

/** @param {any[]} running @param {(id: string) => void} cancel @param {Record<string, string>} refusals of rigs that the person does not drive */
export function showRunning(running, cancel, refusals) {
  byId("running-table").hidden = !running.length;
  byId("running-none").hidden = running.length > 0;
  const rows = running.map((run) =>
    el(
      "tr",
      { id: `running-${run.id}` },
      el("td", { class: "name" }, el("a", { href: `/runs/${run.id}` }, run.name), el("small", { class: "muted" }, `run ${run.number}`)),
      el(
        "td",
        { class: "advance" },
        el("progress", { max: 1, value: run.share, "aria-label": `Progress of run ${run.number}` }),
        el("small", { class: "muted" }, run.doing || "starting"),
      ),
      el("td", { class: "rig" }, run.rig_name),
      el("td", { class: "by" }, run.submitted_by),
      el("td", { class: "number end" }, clock(run.expected_end)),
      el(
        "td",
        { class: "acts", "data-needs": "operator" },
        el(
          "button",
          {
            type: "button",
            class: "quiet small",
            "data-cancel": run.id,
            "aria-label": `Cancel run ${run.number}, ${run.name}`,
            disabled: run.rig_id in refusals,
            title: refusals[run.rig_id],
          },
          "Cancel",
        ),
      ),
    ),
  );
  const host = byId("running-rows");
  const focused = /** @type {any} */ (document.activeElement)?.dataset?.cancel;
  renew(host, ...rows);
  if (focused) host.querySelector(`[data-cancel="${focused}"]`)?.focus();
  host.onclick = async (/** @type {any} */ event) => {
    const button = event.target.closest("[data-cancel]");
    const run = running.find((one) => one.id === button?.dataset.cancel);
    if (run && (await cancelConfirmed(run))) cancel(run.id);
  };
}
