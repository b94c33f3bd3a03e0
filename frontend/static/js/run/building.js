// @ts-check

/**
 * A building in pixels at rest: columns stand at `lines`, floor k lies at `levels[k + 1]`, and `levels[0]` is the ground.
 * @typedef {{lines: number[], levels: number[], left: number, right: number}} Frame
 */

const SLENDEREST = 0.28; // width over height of a drawn building
const WIDEST = 1.5;
const EQUAL_HEIGHT = 3; // m, for a structure given by matrices: its plan has no heights

/** The storey heights of a plan (m), and whether the plan states them. @param {any} structure @param {number} floors @returns {{heights: number[], known: boolean}} */
export function storeys(structure, floors) {
  const heights = structure.storeys?.map((/** @type {any} */ storey) => storey.height);
  return heights ? { heights, known: true } : { heights: Array(floors).fill(EQUAL_HEIGHT), known: false };
}

/**
 * Fit a building into a box: heights to one scale; bays in proportion to one another, but the whole width is chosen to be legible.
 * @param {number[]} heights @param {number[]} bays widths (m); empty: one bay @param {{left: number, right: number, top: number, bottom: number}} box @returns {Frame}
 */
export function fitted(heights, bays, box) {
  const total = heights.reduce((sum, one) => sum + one, 0);
  const tall = box.bottom - box.top;
  const widths = bays.length ? bays : [0.75 * total];
  const wide = widths.reduce((sum, one) => sum + one, 0);
  const room = box.right - box.left;
  const most = bays.length > 1 ? room : Math.max(room * 0.6, 60);
  const width = Math.min(room, Math.max(SLENDEREST, Math.min(WIDEST, wide / total)) * tall, most);
  const left = (box.left + box.right - width) / 2;
  let [x, y] = [left, box.bottom];
  const lines = [x, ...widths.map((one) => (x += (one / wide) * width))];
  const levels = [y, ...heights.map((one) => (y -= (one / total) * tall))];
  return { lines, levels, left, right: left + width };
}

/** The columns of a building whose floors have moved, as path data: each clamped at both ends. @param {Frame} frame @param {number[]} moved pixels, the ground first */
export function columns({ lines, levels }, moved) {
  let path = "";
  for (const x of lines) {
    path += `M${(x + moved[0]).toFixed(1)} ${levels[0]}`;
    for (let k = 1; k < levels.length; k++) {
      const [from, to] = [x + moved[k - 1], x + moved[k]];
      const half = (levels[k] - levels[k - 1]) / 2;
      path += `C${from.toFixed(1)} ${(levels[k - 1] + half).toFixed(1)} ${to.toFixed(1)} ${(levels[k] - half).toFixed(1)} ${to.toFixed(1)} ${levels[k]}`;
    }
  }
  return path;
}

/** The largest magnification of the form 1, 2 or 5 times a power of ten under which `peak` (m) takes at most `room` pixels. @param {number} room @param {number} peak @param {number} scale pixels of one metre */
export function magnification(room, peak, scale) {
  const most = room / (peak * scale);
  if (!(most > 0 && most < Infinity)) return 1;
  const power = 10 ** Math.floor(Math.log10(most));
  return power * (most >= 5 * power ? 5 : most >= 2 * power ? 2 : 1);
}
