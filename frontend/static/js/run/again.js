// @ts-check
// What can be done with a test that has ended: retry it, or undo a cancel in the queue while that is possible.
import { api, explain } from "../api.js";
import { el } from "../dom.js";
import { person } from "../person.js";
import { ended } from "./facts.js";

/**
 * @param {any} run @param {string | undefined} refusal why the person may do neither @param {(reason: string) => void} refused @param {() => void} changed
 * @returns {HTMLElement[]}
 */
export function again(run, refusal, refused, changed) {
  if (!ended(run.state)) return [];
  const act = (/** @type {string} */ path, /** @type {(answer: any) => void} */ then) => async () => {
    try {
      then(await api.post(`/runs/${run.id}/${path}`, { by: person() }));
    } catch (error) {
      refused(explain(error));
    }
  };
  const button = (/** @type {string} */ label, /** @type {() => void} */ click) =>
    el("button", { type: "button", class: "quiet", "data-needs": "operator", disabled: Boolean(refusal), title: refusal, on: { click } }, label);
  const retry = button("Retry this test", act("retry", (one) => location.assign(`/runs/${one.id}`)));
  const undoable = run.undo_until && new Date(run.undo_until) > new Date();
  return undoable ? [button("Undo the cancel", act("undo-cancel", changed)), retry] : [retry];
}
