// @ts-check
import { el } from "../dom.js";
import { attempt } from "./notice.js";
import { kindOf } from "./plan_rows.js";
import { queueVersion } from "./queue_dialog.js";
import { minute, rowButton, tableOf } from "./words.js";

/** @typedef {import("./plan_page.js").Detail} Detail @typedef {import("./plan_rows.js").Version} Version */

const HEADS = ["Compare", "Version", "Comment", "Kind of test", "Author", "Saved", "#Runs", ""];

/** The versions of a plan, newest first, with a way to compare two of them. @param {Detail} plan @param {(first: number, second: number) => void} compare */
export function versionTable(plan, compare) {
  const { history } = plan;
  const boxes = new Map(history.map(({ number }) => [number, el("input", { type: "checkbox", "aria-label": `Compare version ${number}`, on: { change: () => selected() } })]));
  const button = el("button", { type: "button", class: "quiet", on: { click: () => compare(...pair()) } }, "Compare two versions");
  const chosen = () => [...boxes].filter(([, box]) => box.checked).map(([number]) => number);
  /** The two versions to compare, older first. @returns {[number, number]} */
  const pair = () => /** @type {[number, number]} */ (chosen().sort((a, b) => a - b));
  const selected = () => {
    const two = chosen().length === 2;
    button.disabled = !two;
    button.textContent = two ? `Compare versions ${pair().join(" and ")}` : "Select two versions to compare";
    for (const box of boxes.values()) box.disabled = two && !box.checked;
  };
  for (const { number } of history.slice(0, 2)) if (history.length > 1) boxes.get(number).checked = true;
  selected();
  const rows = history.map((one) => row(plan, one, boxes.get(one.number)));
  return el("div", {}, tableOf("Versions of the plan", HEADS, rows), history.length > 1 && el("div", { class: "actions below" }, button));
}

/** @param {Detail} plan @param {Version} version @param {HTMLElement} box */
function row({ id, name }, version, box) {
  const { number, test, comment, saved_by, saved_at, runs, digest } = version;
  return el(
    "tr",
    {},
    el("td", { "data-label": "Compare" }, box),
    el("td", { class: "nowrap", "data-label": "Version", title: `Digest ${digest}` }, el("strong", {}, `Version ${number}`)),
    el("td", { class: "comment", "data-label": "Comment" }, comment || el("span", { class: "muted" }, "no comment")),
    el("td", { "data-label": "Kind of test" }, kindOf(test)),
    el("td", { "data-label": "Author" }, saved_by),
    el("td", { class: "nowrap", "data-label": "Saved" }, minute(saved_at)),
    el("td", { class: "number", "data-label": "Runs" }, String(runs || "–")),
    el(
      "td",
      {},
      el(
        "span",
        { class: "actions" },
        el("a", { class: "button quiet small", href: `/new?library=${id}&version=${number}`, "aria-label": `Open version ${number} in the form` }, "Open"),
        rowButton("Queue", `version ${number}`, () => attempt(() => queueVersion(id, name, number)), "operator"),
        el("a", { href: `/api/v1/library/plans/${id}/versions/${number}/plan.yaml`, "aria-label": `Version ${number} as YAML` }, "YAML"),
      ),
    ),
  );
}
