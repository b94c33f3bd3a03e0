// @ts-check
// Controls of people who do not drive the rig: disabled, and their title says why.

/** @typedef {{approvals: boolean, refusals: Record<string, string>, hold_refusal: string | null, release_refusal: string | null, rigs: {rig_id: string, sentence: string}[]}} Control */

/** The control as long as the service has not said who drives. @type {Control} */
export const UNKNOWN = { approvals: false, refusals: {}, hold_refusal: null, release_refusal: null, rigs: [] };

/** The titles of controls that are not withheld. @type {WeakMap<HTMLElement, string>} */
const titles = new WeakMap();

/**
 * Withhold a control for a reason; without one it is as it was, or disabled where it leads nowhere.
 * @param {any} node @param {string | null | undefined} why @param {boolean} [idle]
 */
export function withhold(node, why, idle = false) {
  if (!titles.has(node)) titles.set(node, node.title);
  const title = why || titles.get(node);
  if (node.title !== title) node.title = title;
  node.disabled = Boolean(why) || idle;
}
