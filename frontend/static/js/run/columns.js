// @ts-check
import { themed } from "./plot_style.js";

/** @typedef {import("./envelope.js").Envelope} Envelope @typedef {import("./figure.js").Series} Series */

/**
 * Draw one series of an envelope as a bar in each pixel column, from its minimum to its maximum and to the end of the column
 * before. A stroke through the same points takes many times longer without a graphics processor, because its segments cross.
 * @param {any} u plot of uPlot @param {Envelope} envelope @param {number} series from 0 @param {Series} style
 */
export function drawColumns(u, envelope, series, { colour, width = 1.25 }) {
  const { left, top, width: wide, height } = u.bbox;
  const { x, y } = u.scales;
  const context = u.ctx;
  const pen = width * devicePixelRatio;
  const toX = (/** @type {number} */ time) => left + ((time - x.min) / (x.max - x.min)) * wide;
  const toY = (/** @type {number} */ value) => top + ((y.max - value) / (y.max - y.min)) * height;
  const values = envelope.values[series];
  const side = Math.max(0, Math.round((pen - devicePixelRatio) / 2));
  context.save();
  context.beginPath();
  context.rect(left, top, wide, height);
  context.clip();
  context.fillStyle = themed(colour);
  let before = NaN;
  let from = Math.floor(toX(2 * envelope.time[0] - envelope.time[1]));
  for (let k = 0; k < envelope.points; k += 2) {
    const to = Math.floor(toX(envelope.time[k + 1]));
    const [a, b] = [values[k], values[k + 1]];
    const [low, high] = before === before ? [Math.min(a, b, before), Math.max(a, b, before)] : [Math.min(a, b), Math.max(a, b)];
    before = b;
    if (low <= high) {
      const [upper, lower] = [toY(high), toY(low)];
      const spare = Math.max(0, pen - (lower - upper)) / 2;
      context.fillRect(from - side, upper - spare, Math.max(1, to - from) + 2 * side, lower - upper + 2 * spare);
    }
    from = to;
  }
  context.restore();
}
