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

/** Draw the annotations: a line at each time, a band over each span, and the number at the head. @param {any} u plot of uPlot @param {import("./annotations.js").Note[]} notes */
export function drawNotes(u, notes) {
  const { left, width, top, height } = u.bbox;
  const size = 11 * devicePixelRatio;
  const inside = (/** @type {number} */ time) => Math.min(left + width, Math.max(left, u.valToPos(time, "x", true)));
  for (const note of notes) {
    const [from, to] = [inside(note.from_s), inside(note.to_s ?? note.from_s)];
    const [low, high] = [u.scales.x.min, u.scales.x.max];
    if (note.from_s > high || (note.to_s ?? note.from_s) < low) continue;
    u.ctx.save();
    u.ctx.fillStyle = u.ctx.strokeStyle = themed("--pico-color");
    u.ctx.globalAlpha = 0.08;
    if (to > from) u.ctx.fillRect(from, top, to - from, height);
    u.ctx.globalAlpha = 1;
    u.ctx.lineWidth = devicePixelRatio;
    u.ctx.beginPath();
    u.ctx.moveTo(from, top);
    u.ctx.lineTo(from, top + height);
    u.ctx.stroke();
    u.ctx.font = `600 ${size}px system-ui, sans-serif`;
    const label = String(note.number);
    const box = u.ctx.measureText(label).width + 0.8 * size;
    const start = Math.min(from, left + width - box);
    u.ctx.fillRect(start, top, box, 1.35 * size);
    u.ctx.fillStyle = themed("--surface");
    u.ctx.textBaseline = "middle";
    u.ctx.textAlign = "center";
    u.ctx.fillText(label, start + box / 2, top + 0.7 * size);
    u.ctx.restore();
  }
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
