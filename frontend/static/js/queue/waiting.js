// @ts-check
// One waiting test as a row that stays the same element while its facts change: it keeps focus, selection and menus.
import { withhold } from "../control/withheld.js";
import { el } from "../dom.js";
import { clock, paceWords, span } from "./words.js";

/** @typedef {{id: string, number: number, name: string, position: number, priority: number, rig_id: string, rig_name: string, submitted_by: string,
 *   pace: number | null, waits: string, expected_s: number | null, expected_from: string, expected_start: string | null,
 *   expected_end: string | null, retry_of: string | null}} Waiting */
/** @typedef {{up: (id: string) => void, down: (id: string) => void, top: (id: string) => void, cancel: (id: string) => void,
 *   priority: (id: string, value: number) => void, select: () => void}} Acts */

const PRIORITIES = [
  [2, "Urgent"],
  [1, "High"],
  [0, "Normal"],
  [-1, "Low"],
];

export class WaitingRow {
  /** @param {Waiting} one @param {Acts} acts */
  constructor(one, acts) {
    this.id = one.id;
    this.check = el("input", { type: "checkbox", on: { change: acts.select } });
    this.handle = el("span", { class: "handle", title: "Drag to another place", "aria-hidden": "true" }, "⠿");
    this.position = el("td", { class: "number place" });
    this.link = el("a", { href: `/runs/${one.id}` });
    this.facts = el("small", { class: "muted" });
    this.priority = el(
      "select",
      { "data-needs": "operator", on: { change: () => acts.priority(one.id, Number(this.priority.value)) } },
      ...PRIORITIES.map(([value, name]) => el("option", { value }, String(name))),
    );
    this.words = el("span", { "data-lacks": "operator" });
    this.rig = el("td", { class: "rig" });
    this.by = el("td", { class: "by" });
    this.waits = el("td", { class: "waits" });
    this.takes = el("td", { class: "number takes" });
    this.start = el("td", { class: "number start" });
    this.end = el("td", { class: "number end" });
    this.top = button("⤒", () => acts.top(one.id));
    this.up = button("↑", () => acts.up(one.id));
    this.down = button("↓", () => acts.down(one.id));
    this.cancel = el("button", { type: "button", class: "quiet small", on: { click: () => acts.cancel(one.id) } }, "Cancel");
    this.node = el(
      "tr",
      { id: `waiting-${one.id}` },
      el("td", { class: "grip", "data-needs": "operator" }, this.handle, this.check),
      this.position,
      el("td", { class: "name" }, this.link, this.facts),
      el("td", { class: "priority" }, this.priority, this.words),
      this.rig,
      this.by,
      this.takes,
      this.start,
      this.end,
      this.waits,
      el("td", { class: "acts", "data-needs": "operator" }, el("div", { class: "actions" }, this.top, this.up, this.down, this.cancel)),
    );
  }

  /** @param {Waiting} one @param {boolean} last @param {string | undefined} refusal why the person may not change it */
  update(one, last, refusal) {
    text(this.position, String(one.position));
    text(this.link, one.name);
    text(this.facts, `run ${one.number}, ${paceWords(one.pace)}${one.retry_of ? ", retry" : ""}`);
    text(this.rig, one.rig_name);
    text(this.by, one.submitted_by);
    text(this.takes, span(one.expected_s));
    this.takes.title = `From ${one.expected_from}`;
    text(this.start, clock(one.expected_start));
    text(this.end, clock(one.expected_end));
    text(this.waits, one.waits);
    text(this.words, String(PRIORITIES.find(([value]) => value === one.priority)?.[1]));
    if (document.activeElement !== this.priority) this.priority.value = String(one.priority);
    for (const [node, label] of [
      [this.check, `Select run ${one.number}`],
      [this.priority, `Priority of run ${one.number}`],
      [this.top, `Move run ${one.number} to the top`],
      [this.up, `Move run ${one.number} up`],
      [this.down, `Move run ${one.number} down`],
      [this.cancel, `Cancel run ${one.number}, ${one.name}`],
    ])
      if (node.getAttribute("aria-label") !== label) node.setAttribute("aria-label", label);
    for (const node of [this.top, this.up]) withhold(node, refusal, one.position === 1);
    withhold(this.down, refusal, last);
    for (const node of [this.priority, this.cancel]) withhold(node, refusal);
    this.handle.hidden = Boolean(refusal);
  }
}

/** @param {string} sign @param {() => void} act */
const button = (sign, act) => el("button", { type: "button", class: "quiet small sign", on: { click: act } }, sign);

/** @param {Element} node @param {string} value */
function text(node, value) {
  if (node.textContent !== value) node.textContent = value;
}
