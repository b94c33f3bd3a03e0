// @ts-check

/**
 * The margin to a limit. On the live page and the wall, colour means this and nothing else (docs/decisions/0040).
 * @typedef {{level: "ok" | "near" | "over" | "none", share: number, words: string}} Margin
 */

export const NEAR = 0.8; // of a limit: from here on a value is near it

const WORDS = { ok: "", near: "near limit", over: "over limit", none: "" };
const RANK = { none: 0, ok: 1, near: 2, over: 3 };

/** The margin of a value to its limit, which is the same in both directions. Without a limit there is no margin. @param {number} value @param {number | null} limit @returns {Margin} */
export function margin(value, limit) {
  if (!limit || !Number.isFinite(value)) return { level: "none", share: NaN, words: "" };
  const share = Math.abs(value) / limit;
  const level = share > 1 ? "over" : share >= NEAR ? "near" : "ok";
  return { level, share, words: WORDS[level] };
}

/** The smallest of some margins. @param {Margin[]} margins @returns {Margin} */
export const smallest = (margins) => margins.reduce((worst, one) => (RANK[one.level] > RANK[worst.level] ? one : worst), margin(NaN, null));
