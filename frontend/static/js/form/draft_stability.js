// @ts-check

const KEY = "rths.stability.draft";

/** Keep the plan of the form for the page of stability, which opens in a window of its own. @param {any} plan */
export function keepForStability(plan) {
  const motion = plan.motion.kind === "inline" ? { ...plan.motion, acceleration: plan.motion.acceleration.slice(0, 2) } : plan.motion;
  localStorage.setItem(KEY, JSON.stringify({ ...plan, motion })); // stability does not depend on the record
}

/** The plan that the form kept, or null. */
export const keptForStability = () => JSON.parse(localStorage.getItem(KEY) ?? "null");
