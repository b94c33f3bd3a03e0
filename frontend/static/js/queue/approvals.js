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

/** Send a decision, or a withdrawal. @param {string} path @param {string} done @param {object} [given] */
async function decide(path, done, given) {
  const refusal = byId("approvals-refusal");
  try {
    await api.post(path, { by: person(), ...given });
    refusal.textContent = "";
    toast(done);
  } catch (error) {
    refusal.textContent = explain(error);
  }
  await show();
}

/** What a person reads before the decision. @param {Waiting} one */
function facts(one) {
  const extent = one.about === "run" ? [one.rig_name, span(one.duration_s), paceWords(one.pace)] : [counted(one.points ?? 0, "point")];
  const digest = el("code", { title: one.digest }, one.digest.slice(0, SHOWN));
  const plan = one.about === "run" ? [", ", el("a", { href: `/api/v1/runs/${one.id}/plan.yaml`, "aria-label": `Plan of run ${one.number} as YAML` }, "plan as YAML")] : [];
  return el("small", {}, `${extent.join(", ")}. Submitted by ${one.asked_by} ${when(one.asked_at)}. Digest `, digest, ...plan);
}

/** @param {Waiting} one */
function item(one) {
  const called = `${one.about === "run" ? "Run" : "Sweep"} ${one.number}, ${one.name}`;
  const reject = async () => {
    const reason = await asked(`Reject ${called}`, "Reason, which the submitter reads", "Reject the submission");
    if (reason) await decide(`/approvals/${one.id}/reject`, `${called}: rejected.`, { reason });
  };
  /** @param {string} label @param {string} kind @param {string} role @param {() => unknown} click */
  const button = (label, kind, role, click) => el("button", { type: "button", class: kind, "data-needs": role, "aria-label": `${label.replace(" …", "")} ${called}`, on: { click } }, label);
  const buttons = one.own
    ? [button("Withdraw", "quiet small", one.about === "run" ? "operator" : "engineer", () => decide(`/${one.about}s/${one.id}/cancel`, `${called}: withdrawn.`))]
    : one.refusal
      ? []
      : [
          button("Approve", "small", "operator", () => decide(`/approvals/${one.id}/approve`, `${called}: approved.`, { digest: one.digest })),
          button("Reject …", "quiet small", "operator", reject),
        ];
  return el(
    "li",
    {},
    el("div", {}, el("a", { href: `/${one.about}s/${one.id}` }, called), facts(one), ...(one.refusal ? [el("small", { class: "muted" }, one.refusal)] : [])),
    el("div", { class: "actions" }, ...buttons),
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
