// @ts-check
// The webhooks: add, test, pause and delete them, and read the log of their deliveries.
import { api, explain } from "../api.js";
import { byId, el } from "../dom.js";
import { when } from "../format.js";
import { person } from "../person.js";

const TEST_MS = 1800; // after which the answer to a test is usually in the log

/** @typedef {{number: number, kind: string, sentence: string, state: string, attempts: number, next_at: string, last_at: string | null, status: number | null, problem: string | null}} Delivery */

/** @param {Delivery} one */
function outcome(one) {
  if (!one.attempts) return "will be sent in a moment";
  const attempts = `${one.attempts} attempt${one.attempts === 1 ? "" : "s"}`;
  if (one.state === "delivered") return `accepted with status ${one.status} after ${attempts}`;
  return `${one.problem} ${attempts}${one.state === "waiting" ? `, again at ${when(one.next_at)}` : ", given up"}`;
}

/** Ids of the webhooks whose deliveries are unfolded: they stay so when the list is drawn again. @type {Set<string>} */
const unfolded = new Set();

/** @param {any} hook */
function card(hook) {
  const log = el("ol", { class: "log" });
  const details = /** @type {HTMLDetailsElement} */ (el("details", {}, el("summary", {}, "Deliveries"), log));
  details.open = unfolded.has(hook.id);
  const fill = async () => {
    const { deliveries } = await api.get(`/webhooks/${hook.id}/deliveries`);
    const items = deliveries.map((/** @type {Delivery} */ one) =>
      el("li", {}, el("strong", {}, one.kind), ` ${when(one.last_at ?? one.next_at)}: ${outcome(one)}`),
    );
    log.replaceChildren(...(items.length ? items : [el("li", {}, "Nothing was delivered yet. Send a test, or wait for an event.")]));
  };
  details.addEventListener("toggle", () => {
    if (details.open) void fill();
    if (details.isConnected) unfolded[details.open ? "add" : "delete"](hook.id);
  });
  const act = (/** @type {string} */ label, /** @type {() => void} */ click) =>
    el("button", { type: "button", class: "quiet small", "aria-label": `${label}: ${hook.url}`, on: { click } }, label);
  return el(
    "article",
    { class: "webhook" },
    el("p", {}, el("strong", {}, hook.url), hook.enabled ? false : " (paused)"),
    el("p", { class: "muted" }, `${hook.kinds.join(", ")}. Added by ${hook.added_by}. `, hook.last ? `Last delivery: ${outcome(hook.last)}.` : "Nothing delivered yet."),
    el(
      "div",
      { class: "actions" },
      act("Send a test", () =>
        change(async () => {
          await api.post(`/webhooks/${hook.id}/test`, {});
          setTimeout(show, TEST_MS);
        }),
      ),
      act(hook.enabled ? "Pause the webhook" : "Resume the webhook", () =>
        change(() => api.patch(`/webhooks/${hook.id}`, { enabled: !hook.enabled })),
      ),
      act("Delete the webhook", () => change(() => api.remove(`/webhooks/${hook.id}`))),
    ),
    details,
  );
}

/** @param {() => Promise<unknown>} send */
async function change(send) {
  byId("webhook-refusal").textContent = "";
  try {
    await send();
  } catch (error) {
    byId("webhook-refusal").textContent = explain(error);
  }
  await show();
}

async function show() {
  const { webhooks } = await api.get("/webhooks");
  const none = el("p", { class: "empty" }, "No webhook yet. Add one below, and send a test to see that its address accepts it.");
  byId("webhook-rows").replaceChildren(...(webhooks.length ? webhooks.map(card) : [none]));
}

byId("webhook-form").addEventListener("submit", (/** @type {any} */ event) => {
  event.preventDefault();
  const form = event.target;
  const kinds = [...form.querySelectorAll('[name="kind"]:checked')].map((/** @type {any} */ box) => box.value);
  change(async () => {
    const added = await api.post("/webhooks", { url: byId("webhook-url").value.trim(), kinds, secret: byId("webhook-key").value, by: person() });
    byId("webhook-secret").textContent = `The secret of the signature is ${added.secret}. Keep it now: it is not shown again.`;
    byId("webhook-secret").hidden = false;
    form.reset();
  });
});
show().catch((error) => (byId("webhook-refusal").textContent = explain(error)));
