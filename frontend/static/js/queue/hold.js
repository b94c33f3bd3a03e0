// @ts-check
// Hold and release of the queue: the banner says who holds it, since when and why.
import { withhold } from "../control/withheld.js";
import { byId } from "../dom.js";
import { person } from "../person.js";
import { clock } from "./words.js";

/** @type {(path: string, data: object) => Promise<void>} */
let send;

/** @param {any} queue @param {(path: string, data: object) => Promise<void>} change @param {import("../control/withheld.js").Control} control */
export function holding(queue, change, control) {
  send = change;
  withhold(byId("hold-form").querySelector("button"), control.hold_refusal);
  withhold(byId("release"), control.release_refusal);
  byId("held").hidden = !queue.held;
  byId("running-next").hidden = queue.held;
  byId("hold-form").hidden = queue.held;
  if (!queue.held) return;
  byId("held-by").textContent = `${queue.held_by ?? "unnamed"} since ${clock(queue.held_at)}`;
  byId("held-reason").textContent = queue.held_reason ? `Reason: ${queue.held_reason}.` : "";
}

byId("hold-form").addEventListener("submit", async (/** @type {Event} */ event) => {
  event.preventDefault();
  const field = byId("hold-reason");
  await send("/queue/hold", { by: person(), reason: field.value });
  field.value = "";
  byId("release").focus();
});
byId("release").addEventListener("click", () => send("/queue/release", { by: person() }));
