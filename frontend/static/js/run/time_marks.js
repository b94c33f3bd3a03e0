// @ts-check
import { themed } from "./plot_style.js";

/** Draw both limits as dashed lines where the axis includes them. @param {any} u plot of uPlot @param {number} limit */
export function drawLimits(u, limit) {
  const { left, width, top, height } = u.bbox;
  for (const value of [-limit, limit]) {
    const y = u.valToPos(value, "y", true);
    if (y >= top && y <= top + height) stroke(u.ctx, [5, 4], (/** @type {CanvasRenderingContext2D} */ context) => (context.moveTo(left, y), context.lineTo(left + width, y)));
  }
}

/** Draw the vertical mark of a trip. @param {any} u plot of uPlot @param {number} time (s) */
export function drawTrip(u, time) {
  const { left, width, top, height } = u.bbox;
  const x = u.valToPos(time, "x", true);
  if (x >= left && x <= left + width) stroke(u.ctx, [], (/** @type {CanvasRenderingContext2D} */ context) => (context.moveTo(x, top), context.lineTo(x, top + height)), 2);
}

/** @param {CanvasRenderingContext2D} context @param {number[]} dash @param {(context: CanvasRenderingContext2D) => void} path @param {number} [width] */
function stroke(context, dash, path, width = 1.25) {
  context.save();
  context.strokeStyle = themed("--margin-over");
  context.lineWidth = width * devicePixelRatio;
  context.setLineDash(dash.map((one) => one * devicePixelRatio));
  context.beginPath();
  path(context);
  context.stroke();
  context.restore();
}
