// @ts-check
// What waits for approval: a group of its own on the page of the queue, hidden while nothing waits.
import { api, explain } from "../api.js";
import { asked } from "../control/reason.js";
import { byId, el, renew } from "../dom.js";
import { when } from "../format.js";
import { person } from "../person.js";

/** @typedef {{about: "run" | "sweep", id: string, number: number, name: string, rig_name: string | null, points: number | null, digest: string, asked_by: string, asked_at: string, refusal: string | null}} Waiting */

const POLL_MS = 5000;

/** @param {Waiting} one @param {string} what @param {object} given */
async function decide(one, what, given) {
  const refusal = byId("approvals-refusal");
  try {
    await api.post(`/approvals/${one.id}/${what}`, { by: person(), ...given });
    refusal.textContent = "";
  } catch (error) {
    refusal.textContent = explain(error);
  }
  await show();
}

/** @param {Waiting} one */
function item(one) {
  const called = `${one.about === "run" ? "Run" : "Sweep"} ${one.number}, ${one.name}`;
  const where = one.rig_name ?? `${one.points} points`;
  const reject = async () => {
    const reason = await asked(`Reject ${called}`, "Reason, which the submitter reads", "Reject the submission");
    if (reason) await decide(one, "reject", { reason });
  };
  const buttons = one.refusal
    ? [el("span", { class: "muted" }, one.refusal)]
    : [
        el("button", { type: "button", class: "small", "data-needs": "operator", "aria-label": `Approve ${called}`, on: { click: () => decide(one, "approve", { digest: one.digest }) } }, "Approve"),
        el("button", { type: "button", class: "quiet small", "data-needs": "operator", "aria-label": `Reject ${called}`, on: { click: reject } }, "Reject …"),
      ];
  return el(
    "li",
    {},
    el("span", {}, el("a", { href: `/${one.about}s/${one.id}` }, called), `: ${where}, submitted by ${one.asked_by} ${when(one.asked_at)}`),
    el("span", { class: "actions" }, ...buttons),
  );
}

async function show() {
  const { approvals } = await api.get(`/approvals?by=${encodeURIComponent(person())}`);
  byId("approvals").hidden = !approvals.length;
  renew(byId("approvals-list"), ...approvals.map(item));
}

async function poll() {
  await show().catch(() => null);
  setTimeout(poll, POLL_MS);
}
void poll();
