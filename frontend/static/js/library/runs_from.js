// @ts-check
import { api } from "../api.js";
import { byId, el } from "../dom.js";
import { showDifferences } from "./diff.js";
import { attempt } from "./notice.js";
import { minute, rowButton, tableOf } from "./words.js";

/**
 * @typedef {{id: string, number: number, name: string, state: string, reason: string | null, submitted_by: string, submitted_at: string,
 *   version: number, changed: boolean}} FromVersion
 */

const MOST = 20; // runs that the page of comparisons takes
const HEADS = ["#Run", "Test", "Status", "Version", "By", "Submitted", "Reason", ""];

/** Show the runs that were queued from a plan. @param {{id: string}} plan */
export async function showRuns({ id }) {
  const { runs, total } = await api.get(`/library/plans/${id}/runs?limit=${MOST}`);
  const ended = runs.filter((/** @type {FromVersion} */ { state }) => state === "completed" || state === "tripped");
  const link = byId("compare-runs");
  link.hidden = ended.length < 2;
  link.href = `/compare?items=${ended.map((/** @type {FromVersion} */ one) => `run:${one.id}`).join(",")}`;
  link.textContent = `Compare its ${ended.length} runs`;
  const more = total > runs.length && el("p", { class: "muted" }, `The newest ${runs.length} of ${total} runs.`);
  const none = () => el("p", { class: "empty" }, "No run yet. Runs appear here when you queue a version, from this page or from the form.");
  byId("runs").replaceChildren(...(runs.length ? [tableOf("Table of the runs", HEADS, runs.map((/** @type {FromVersion} */ run) => row(id, run))), more || ""] : [none()]));
}

/** @param {string} id @param {FromVersion} run */
function row(id, run) {
  const { number, name, state, version, changed, submitted_by, submitted_at, reason } = run;
  const differ = async () => {
    await showDifferences(`version:${id}:${version}`, `run:${run.id}`);
    byId("differences-title").focus();
  };
  return el(
    "tr",
    {},
    el("td", { class: "number", "data-label": "Run" }, String(number)),
    el("td", { class: "name", "data-label": "Test" }, el("a", { href: `/runs/${run.id}`, title: name }, name)),
    el("td", { "data-label": "Status" }, el("span", { class: `badge ${state}` }, state)),
    el("td", { class: "nowrap", "data-label": "Version" }, `${version}${changed ? ", changed" : ""}`),
    el("td", { "data-label": "By" }, submitted_by),
    el("td", { class: "nowrap", "data-label": "Submitted" }, minute(submitted_at)),
    el("td", { class: "comment", "data-label": "Reason" }, reason ?? "–"),
    el("td", {}, el("span", { class: "actions" }, changed && rowButton("Show changes", `of run ${number} against version ${version}`, () => attempt(differ)))),
  );
}
