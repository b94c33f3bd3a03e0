// @ts-check
import { byId, colour, el } from "../dom.js";
import { shaded } from "./plotting.js";
import { digits, titled } from "./results.js";

/** @typedef {import("./results.js").Results} Results @typedef {import("./results.js").Column} Column */

const [TOP, BOTTOM, SIDE] = [46, 22, 100]; // CSS pixels around the axes
const CLICK = 4; // a shorter drag is a click
const NEAR = 6; // pixels between a click and the line that it chooses

/** Inputs and the measure of all points, a line each. A drag along an axis filters the points. */
export class Parallel {
  /** @type {{column: Column, low: number, high: number, x: number}[]} */
  axes = [];
  measure = "";

  /** @param {Results} results @param {(row: number) => void} choose @param {() => void} filtered */
  constructor(results, choose, filtered) {
    this.results = results;
    this.choose = choose;
    this.filtered = filtered;
    this.box = byId("parallel");
    this.canvas = el("canvas");
    this.box.replaceChildren(this.canvas);
    this.canvas.addEventListener("pointerdown", (/** @type {PointerEvent} */ event) => this.#drag(event));
    new ResizeObserver(() => this.draw(this.measure)).observe(this.box);
  }

  /** @param {string} measure */
  draw(measure) {
    this.measure = measure;
    const { results, box, canvas } = this;
    const [width, height] = [box.clientWidth, box.clientHeight];
    if (!measure || !width || !results.size) return;
    const ratio = devicePixelRatio || 1;
    canvas.width = width * ratio;
    canvas.height = height * ratio;
    canvas.style.width = `${width}px`;
    canvas.style.height = `${height}px`;
    const varied = results.columns.filter(({ key, role }) => role === "input" && new Set(results.values[key]).size > 1);
    const columns = [...varied, results.column(measure)];
    this.axes = columns.map((column, k) => {
      const some = results.values.point.map((_, row) => results.number(column.key, row)).filter(Number.isFinite);
      const [low, high] = [Math.min(...some), Math.max(...some)];
      return { column, low, high: high > low ? high : low + 1, x: columns.length > 1 ? SIDE + (k * (width - 2 * SIDE)) / (columns.length - 1) : width / 2 };
    });
    const pen = canvas.getContext("2d");
    pen.scale(ratio, ratio);
    this.#lines(pen, height);
    this.#frames(pen, height);
  }

  /** @param {{low: number, high: number}} axis @param {number} value @param {number} height */
  #y({ low, high }, value, height) {
    return height - BOTTOM - ((value - low) / (high - low)) * (height - TOP - BOTTOM);
  }

  /** @param {any} pen @param {number} height */
  #lines(pen, height) {
    const { results, axes } = this;
    const last = axes[axes.length - 1];
    const faded = colour("--pico-muted-border-color");
    const order = results.values.point.map((_, row) => row).sort((a, b) => Number(results.passes(a)) - Number(results.passes(b)));
    for (const row of order) {
      const value = results.number(last.column.key, row);
      const passes = results.passes(row);
      pen.strokeStyle = passes && Number.isFinite(value) ? shaded(0.15 + (0.85 * (value - last.low)) / (last.high - last.low)) : faded;
      pen.globalAlpha = passes ? Math.min(1, 0.25 + 60 / results.size) : 0.35;
      pen.lineWidth = passes ? 1.3 : 0.7;
      pen.beginPath();
      let drawing = false;
      for (const axis of axes) {
        const at = results.number(axis.column.key, row);
        if (!Number.isFinite(at)) {
          drawing = false;
          continue;
        }
        if (drawing) pen.lineTo(axis.x, this.#y(axis, at, height));
        else pen.moveTo(axis.x, this.#y(axis, at, height));
        drawing = true;
      }
      pen.stroke();
    }
    pen.globalAlpha = 1;
  }

  /** @param {any} pen @param {number} height */
  #frames(pen, height) {
    const [text, line] = [colour("--pico-color"), colour("--pico-muted-color")];
    pen.font = "12px system-ui, sans-serif";
    pen.textAlign = "center";
    const room = this.axes.length > 1 ? Math.min(this.axes[1].x - this.axes[0].x, 2 * SIDE) - 8 : 400;
    for (const axis of this.axes) {
      const { column, x, low, high } = axis;
      pen.strokeStyle = line;
      pen.lineWidth = 1;
      pen.strokeRect(x, TOP, 0, height - TOP - BOTTOM);
      const range = this.results.ranges.get(column.key);
      if (range) {
        const [from, to] = range.map((value) => Math.min(height - BOTTOM, Math.max(TOP, this.#y(axis, value, height))));
        pen.fillStyle = colour("--pico-primary");
        pen.globalAlpha = 0.35;
        pen.fillRect(x - 7, to, 14, Math.max(2, from - to));
        pen.globalAlpha = 1;
      }
      pen.fillStyle = text;
      const parts = titled(column).split(": ");
      pen.fillText(shortened(parts.slice(0, -1).join(": "), room, pen), x, 13);
      pen.fillText(shortened(parts[parts.length - 1], room, pen), x, 27);
      pen.fillStyle = line;
      const names = column.categories;
      const ends = names.length ? [names[Math.round(high)], names[Math.round(low)]] : [digits(high), digits(low)];
      pen.fillText(shortened(ends[0] ?? "", room, pen), x, TOP - 5);
      pen.fillText(shortened(ends[1] ?? "", room, pen), x, height - BOTTOM + 14);
    }
  }

  /** @param {PointerEvent} down */
  #drag(down) {
    const box = this.canvas.getBoundingClientRect();
    const [x, y] = [down.clientX - box.left, down.clientY - box.top];
    const axis = this.axes.reduce((best, one) => (Math.abs(one.x - x) < Math.abs(best.x - x) ? one : best), this.axes[0]);
    if (!axis) return;
    const value = (/** @type {number} */ at) => axis.low + ((box.height - BOTTOM - at) / (box.height - TOP - BOTTOM)) * (axis.high - axis.low);
    const move = (/** @type {PointerEvent} */ event) => {
      const end = event.clientY - box.top;
      if (Math.abs(end - y) < CLICK || Math.abs(axis.x - x) > 20) return;
      const ends = [value(y), value(end)].sort((a, b) => a - b);
      this.results.ranges.set(axis.column.key, [ends[0], ends[1]]);
      this.filtered();
    };
    const up = (/** @type {PointerEvent} */ event) => {
      removeEventListener("pointermove", move);
      if (Math.abs(event.clientY - box.top - y) >= CLICK) return;
      if (Math.abs(axis.x - x) < 10 && this.results.ranges.delete(axis.column.key)) this.filtered();
      else this.#pick(x, y, box.height);
    };
    addEventListener("pointermove", move);
    addEventListener("pointerup", up, { once: true });
  }

  /** Choose the point whose line is nearest. @param {number} x @param {number} y @param {number} height */
  #pick(x, y, height) {
    const after = this.axes.findIndex((axis) => axis.x >= x);
    const [left, right] = [this.axes[Math.max(0, after - 1)], this.axes[Math.max(0, after)]];
    let [found, least] = [-1, NEAR];
    for (let row = 0; row < this.results.size; row++) {
      if (!this.results.passes(row)) continue;
      const [from, to] = [left, right].map((axis) => this.#y(axis, this.results.number(axis.column.key, row), height));
      const share = right.x > left.x ? (x - left.x) / (right.x - left.x) : 0;
      const far = Math.abs(from + share * (to - from) - y);
      if (far < least) [found, least] = [row, far];
    }
    if (found >= 0) this.choose(found);
  }
}

/** A text that fits a width. @param {string} text @param {number} room @param {any} pen */
function shortened(text, room, pen) {
  let shown = text;
  while (shown.length > 3 && pen.measureText(shown).width > room) shown = `${shown.slice(0, -2).trimEnd()}…`;
  return shown;
}
