// @ts-check
// What waits for approval: a group of its own on the page of the queue, hidden while nothing waits.
import { api, explain } from "../api.js";
import { keepingFocus } from "../control/focus.js";
import { asked } from "../control/reason.js";
import { byId, el, renew } from "../dom.js";
import { when } from "../format.js";
import { person } from "../person.js";
import { toast } from "../toast.js";
import { counted, paceWords, span } from "./words.js";

/** @typedef {{about: "run" | "sweep", id: string, number: number, name: string, rig_name: string | null,
 *   duration_s: number | null, pace: number | null, points: number | null, digest: string, asked_by: string, asked_at: string, own: boolean, refusal: string | null}} Waiting */

const POLL_MS = 5000;
const SHOWN = 8; // characters of a digest

/** Send a decision, or a withdrawal, and say what became of it. @param {Waiting} one @param {string} done @param {() => Promise<unknown>} send */
async function change(one, done, send) {
  const refusal = byId("approvals-refusal");
  try {
    await send();
    refusal.textContent = "";
    toast(`${called(one)}: ${done}.`);
  } catch (error) {
    refusal.textContent = explain(error);
  }
  await show();
}

/** @param {Waiting} one @param {string} what @param {object} given */
const decide = (one, what, given) => api.post(`/approvals/${one.id}/${what}`, { by: person(), ...given });

/** @param {Waiting} one */
const called = (one) => `${one.about === "run" ? "Run" : "Sweep"} ${one.number}, ${one.name}`;

/** @param {Waiting} one */
async function reject(one) {
  const reason = await asked(`Reject ${called(one)}`, "Reason, which the submitter reads", "Reject the submission");
  if (reason) await change(one, "rejected", () => decide(one, "reject", { reason }));
}

/** What a person reads before the decision. @param {Waiting} one */
function facts(one) {
  const extent = one.about === "run" ? [one.rig_name, span(one.duration_s), paceWords(one.pace)] : [counted(one.points ?? 0, "point")];
  const digest = el("code", { title: one.digest }, one.digest.slice(0, SHOWN));
  const plan = one.about === "run" ? [", ", el("a", { href: `/api/v1/runs/${one.id}/plan.yaml`, "aria-label": `Plan of run ${one.number} as YAML` }, "plan as YAML")] : [];
  return el("small", {}, `${extent.join(", ")}. Submitted by ${one.asked_by} ${when(one.asked_at)}. Digest `, digest, ...plan);
}

/** What the person of this page may do about it. @param {Waiting} one */
function buttons(one) {
  /** @param {string} label @param {string} kind @param {string} needs @param {() => unknown} click */
  const button = (label, kind, needs, click) =>
    el("button", { type: "button", class: kind, "data-needs": needs, "aria-label": `${label.replace(" …", "")} ${called(one)}`, on: { click } }, label);
  /** @param {() => Promise<unknown>} send */
  const withdraw = (send) => () => change(one, "withdrawn", send);
  const by = { by: person() };
  if (one.own && one.about === "run") return [button("Withdraw", "quiet small", "operator", withdraw(() => api.post(`/runs/${one.id}/cancel`, by)))];
  if (one.own) return [button("Withdraw", "quiet small", "engineer", withdraw(() => api.post(`/sweeps/${one.id}/cancel`, by)))];
  if (one.refusal) return [];
  const approve = () => change(one, "approved", () => decide(one, "approve", { digest: one.digest }));
  return [button("Approve", "small", "operator", approve), button("Reject …", "quiet small", "operator", () => reject(one))];
}

/** @param {Waiting} one */
function item(one) {
  const why = one.refusal ? [el("small", { class: "muted" }, one.refusal)] : [];
  return el(
    "li",
    {},
    el("div", {}, el("a", { href: `/${one.about}s/${one.id}` }, called(one)), facts(one), ...why),
    el("div", { class: "actions" }, ...buttons(one)),
  );
}

async function show() {
  const { approvals } = await api.get(`/approvals?by=${encodeURIComponent(person())}`);
  const list = byId("approvals-list");
  keepingFocus(list, () => {
    byId("approvals").hidden = !approvals.length;
    renew(list, ...approvals.map(item));
  });
}

async function poll() {
  await show().catch(() => null);
  setTimeout(poll, POLL_MS);
}
void poll();
