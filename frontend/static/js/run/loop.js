// @ts-check
import { el } from "../dom.js";
import { through } from "./loop_path.js";
import { padded, themed, tickLabels, tickPlaces } from "./plot_style.js";
import { extremes } from "./store.js";

/** @typedef {import("./store.js").Store} Store @typedef {{index: number, label: string, unit: string, limit?: number | null}} Axis */

/**
 * What a loop shows: the samples of the window [from, to] up to the time `until`, with its head at the time `head`. `close` fits
 * the axes to the window, otherwise they fit the whole test; `ended`: the test grows no more. @typedef {{from: number, to: number, until: number, head: number, close: boolean, ended: boolean}} Shown
 */

const TAIL_S = 2; // time of the test that the tail shows
const FADE = 12; // steps of the tail
const STROKE = 128; // samples of one stroke: a stroke of thousands of segments that cross takes much longer than its parts
const SPARE = 0.18; // of the range: room when a running test outgrows its axes

/**
 * One signal against another on a canvas: the path so far, limits as lines, and a bright head with a fading tail. Only new samples
 * are drawn, until the axes change.
 *
 *     const loop = new Loop(box, x, y);
 *     loop.draw(store, {from: 0, to: store.end, until: store.now, head: store.now, close: false, ended: false});
 */
export class Loop {
  /** @param {HTMLElement} box @param {Axis} x @param {Axis} y @param {boolean} [alike] equal axes, and a line where both signals are equal */
  constructor(box, x, y, alike = false) {
    this.box = box;
    this.x = x;
    this.y = y;
    this.alike = alike;
    this.still = el("canvas", { class: "loop-still" });
    this.moving = el("canvas", { class: "loop-moving" });
    box.replaceChildren(el("div", { class: "loop-layers" }, this.still, this.moving));
    /** @type {[[number, number], [number, number]]} */
    this.range = [[0, 0], [0, 0]];
    this.drawn = 0;
    this.signature = "";
  }

  /** @param {Store} store @param {Shown} shown */
  draw(store, { from, to, until, head, close, ended }) {
    const { clientWidth: width, clientHeight: height } = this.box;
    if (width < 60 || height < 60) return;
    const first = Math.max(0, Math.floor(from / store.step));
    const last = Math.max(first, Math.min(store.count, Math.ceil(to / store.step)));
    const end = Math.max(first, Math.min(last, Math.round(until / store.step)));
    this.#fit(store, first, last, close, ended);
    const signature = [width, height, devicePixelRatio, first, this.range, themed("--ink-line"), document.documentElement.className].join();
    if (signature !== this.signature || end < this.drawn) {
      this.signature = signature;
      this.#axes(width, height);
      this.drawn = first;
    }
    this.#path(store, Math.max(first, this.drawn - 1), end);
    this.drawn = end;
    this.#head(store, first, Math.min(last, store.at(head) + 1));
  }

  /** Choose the axes. @param {Store} store @param {number} first @param {number} last @param {boolean} close @param {boolean} ended */
  #fit(store, first, last, close, ended) {
    const found = [this.x.index, this.y.index].map((c) => (close ? extremes(store.last[c], store.last[c], first, last) : [store.lowest[c], store.highest[c]]));
    if (this.alike) found.fill([Math.min(found[0][0], found[1][0]), Math.max(found[0][1], found[1][1])]);
    found.forEach(([low, high], i) => {
      const [least, most] = this.range[i];
      const fits = low >= least && high <= most && !close && !ended && !this.exact;
      if (!fits) this.range[i] = /** @type {[number, number]} */ (close || ended ? padded(low, high) : spare(low, high));
    });
    this.exact = close || ended;
  }

  /** @param {number} width @param {number} height */
  #axes(width, height) {
    const ratio = devicePixelRatio;
    this.clean = true;
    for (const canvas of [this.still, this.moving]) [canvas.width, canvas.height] = [Math.round(width * ratio), Math.round(height * ratio)];
    const context = this.still.getContext("2d");
    const font = Math.max(11, Math.round(parseFloat(getComputedStyle(this.box).fontSize) * 0.82));
    const [left, bottom] = [font * 4.4, font * 2.9];
    this.area = { left: left * ratio, top: 8 * ratio, right: (width - 12) * ratio, bottom: (height - bottom) * ratio, ratio };
    const { area } = this;
    context.font = `${font * ratio}px system-ui, sans-serif`;
    context.lineWidth = ratio;
    const [xs, ys] = this.range.map((range, i) => tickPlaces(range, (i ? area.bottom - area.top : area.right - area.left) / ratio / (i ? 46 : 64)));
    context.fillStyle = themed("--ink-soft");
    context.textAlign = "center";
    const labels = { x: tickLabels(xs), y: tickLabels(ys) };
    xs.forEach((at, i) => {
      this.#rule(context, this.#toX(at), area.top, this.#toX(at), area.bottom, at === 0 ? "--ink-zero" : "--grid");
      context.fillText(labels.x[i], this.#toX(at), area.bottom + font * 1.25 * ratio);
    });
    context.textAlign = "right";
    ys.forEach((at, i) => {
      this.#rule(context, area.left, this.#toY(at), area.right, this.#toY(at), at === 0 ? "--ink-zero" : "--grid");
      context.fillText(labels.y[i], area.left - 6 * ratio, this.#toY(at) + font * 0.35 * ratio);
    });
    this.#titles(context, font);
    this.#limits(context);
    if (this.alike) this.#rule(context, this.#toX(this.range[0][0]), this.#toY(this.range[0][0]), this.#toX(this.range[0][1]), this.#toY(this.range[0][1]), "--ink-command");
  }

  /** @param {CanvasRenderingContext2D} context @param {number} font */
  #titles(context, font) {
    const { left, right, top, bottom, ratio } = /** @type {any} */ (this.area);
    context.textAlign = "center";
    context.fillText(named(this.x), (left + right) / 2, bottom + font * 2.55 * ratio);
    context.save();
    context.translate(font * ratio, (top + bottom) / 2);
    context.rotate(-Math.PI / 2);
    context.fillText(named(this.y), 0, 0);
    context.restore();
  }

  /** The limits that lie within the axes. @param {CanvasRenderingContext2D} context */
  #limits(context) {
    const { left, right, top, bottom, ratio } = /** @type {any} */ (this.area);
    context.setLineDash([5 * ratio, 4 * ratio]);
    for (const side of [-1, 1]) {
      const [x, y] = [side * (this.x.limit ?? NaN), side * (this.y.limit ?? NaN)];
      if (x > this.range[0][0] && x < this.range[0][1]) this.#rule(context, this.#toX(x), top, this.#toX(x), bottom, "--margin-over");
      if (y > this.range[1][0] && y < this.range[1][1]) this.#rule(context, left, this.#toY(y), right, this.#toY(y), "--margin-over");
    }
    context.setLineDash([]);
  }

  /** @param {CanvasRenderingContext2D} context @param {number} x1 @param {number} y1 @param {number} x2 @param {number} y2 @param {string} ink */
  #rule(context, x1, y1, x2, y2, ink) {
    context.strokeStyle = themed(ink);
    context.beginPath();
    context.moveTo(x1, y1);
    context.lineTo(x2, y2);
    context.stroke();
  }

  /** Draw the samples [first, end). @param {Store} store @param {number} first @param {number} end */
  #path(store, first, end) {
    if (end - first < 2) return;
    const context = this.still.getContext("2d");
    context.strokeStyle = themed("--ink-path");
    context.lineWidth = 1.1 * (this.area?.ratio ?? 1);
    this.#trace(context, store, first, end);
  }

  /** Draw the tail and the head before sample `end`. @param {Store} store @param {number} first @param {number} end */
  #head(store, first, end) {
    const context = this.moving.getContext("2d");
    if (!this.clean) context.clearRect(0, 0, this.moving.width, this.moving.height); // in a print it would clear the layer below too
    this.clean = false;
    const start = Math.max(first, end - Math.round(TAIL_S / store.step));
    const ratio = this.area?.ratio ?? 1;
    context.strokeStyle = context.fillStyle = themed("--ink-head");
    context.lineCap = "round";
    for (let k = 0; k < FADE; k++) {
      const [a, b] = [start + Math.floor(((end - start) * k) / FADE), start + Math.floor(((end - start) * (k + 1)) / FADE)];
      context.globalAlpha = ((k + 1) / FADE) ** 1.5;
      context.lineWidth = (1 + (1.6 * (k + 1)) / FADE) * ratio;
      this.#trace(context, store, Math.max(start, a - 1), b);
    }
    context.globalAlpha = 1;
    const [x, y] = [store.last[this.x.index][end - 1], store.last[this.y.index][end - 1]];
    if (end <= first || !Number.isFinite(x) || !Number.isFinite(y)) return;
    context.beginPath();
    context.arc(this.#toX(x), this.#toY(y), 4.5 * ratio, 0, 2 * Math.PI);
    context.fill();
    context.lineWidth = 2 * ratio;
    context.strokeStyle = themed("--surface");
    context.stroke();
  }

  /** @param {CanvasRenderingContext2D} context @param {Store} store @param {number} first @param {number} end */
  #trace(context, store, first, end) {
    for (let start = first; start < end - 1; start += STROKE) {
      context.beginPath();
      through(context, store.last[this.x.index], store.last[this.y.index], start, Math.min(end, start + STROKE + 1), (x) => this.#toX(x), (y) => this.#toY(y));
      context.stroke();
    }
  }

  /** @param {number} x */
  #toX(x) {
    const { left, right } = /** @type {any} */ (this.area);
    const [low, high] = this.range[0];
    return left + ((x - low) / (high - low)) * (right - left);
  }

  /** @param {number} y */
  #toY(y) {
    const { top, bottom } = /** @type {any} */ (this.area);
    const [low, high] = this.range[1];
    return bottom - ((y - low) / (high - low)) * (bottom - top);
  }
}

/** @param {number} low @param {number} high @returns {[number, number]} */
function spare(low, high) {
  if (!(high >= low)) return [-1, 1];
  const room = (high - low) * SPARE || 1;
  return [low - room, high + room];
}

/** @param {Axis} axis */
const named = ({ label, unit }) => (unit ? `${label}, ${unit}` : label);
