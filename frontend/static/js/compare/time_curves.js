// @ts-check
import { padded } from "../run/plot_style.js";
import { Curves } from "./curves.js";
import { valueAt, within } from "./signals.js";

/** @typedef {import("./view.js").View} View @typedef {import("./signals.js").Series} Series */

const KEYS = "Arrow keys move the cursor. Plus and minus zoom. Escape shows the whole time.";
const NEAR = 10; // CSS pixels between the cursor and the curve that it highlights

/** A signal of all items against time. The charts share their time range and cursor. */
export class TimeCurves extends Curves {
  /** @param {View} view @param {string} role @param {string} label @param {string} unit */
  constructor(view, role, label, unit) {
    super(view, unit ? `${label}, ${unit}` : label, `${label} of all items against time. ${KEYS}`, ["Time, s", ""]);
    this.role = role;
    this.box.addEventListener("keydown", (/** @type {KeyboardEvent} */ event) => this.#key(event));
    this.box.addEventListener("focus", () => view.ask(this));
  }

  /** @param {number} item */
  series(item) {
    return this.view.signals.get(item, this.role);
  }

  /** @returns {[[number, number], [number, number]]} */
  ranges() {
    let [low, high] = [Infinity, -Infinity];
    const range = this.view.range();
    for (const item of this.view.order()) {
      const series = this.series(item);
      if (!series) continue;
      const [first, end] = within(series, range);
      for (let k = first; k < end; k++) {
        const value = series.values[k];
        if (value < low && value > -Infinity) low = value;
        if (value > high && value < Infinity) high = value;
      }
    }
    return [range, padded(low, high)];
  }

  /** @param {number} item @param {import("./curves.js").Place} place */
  path(item, place) {
    const series = this.series(item);
    if (!series) return null;
    const path = new Path2D();
    const [first, end] = within(series, this.view.range());
    let drawing = false;
    for (let k = first; k < end; k++) {
      const value = series.values[k];
      if (!Number.isFinite(value)) {
        drawing = false; // a missing sample is a gap
        continue;
      }
      const [x, y] = [place.x(series.start_s + k * series.step_s), place.y(value)];
      if (drawing) path.lineTo(x, y);
      else path.moveTo(x, y);
      drawing = true;
    }
    return path;
  }

  cursor() {
    const { plot, view } = this;
    if (!plot) return;
    const left = view.time === null ? -10 : plot.valToPos(view.time, "x");
    plot.setCursor({ left, top: left < 0 ? -10 : 10 }, false);
  }

  /** @returns {any} */
  options() {
    const { view } = this;
    return {
      cursor: {
        points: { show: false },
        y: false,
        drag: { x: true, y: false, setScale: false },
        bind: { dblclick: () => () => (view.zoomTo(null), null) },
      },
      hooks: {
        setSelect: [(/** @type {any} */ u) => this.#selected(u)],
        setCursor: [(/** @type {any} */ u) => this.#moved(u)],
      },
    };
  }

  /** @param {any} u */
  #moved(u) {
    const { left, top, event } = u.cursor;
    if (!event) return;
    this.view.ask(this);
    if (left < 0) {
      this.view.highlight(null);
      return this.view.moveCursor(null);
    }
    const time = u.posToVal(left, "x");
    this.view.highlight(this.#nearest(u, time, top));
    this.view.moveCursor(time);
  }

  /** The shown item whose curve is nearest to the cursor; null where none is near. @param {any} u @param {number} time @param {number} top */
  #nearest(u, time, top) {
    let [found, least] = [/** @type {number | null} */ (null), NEAR];
    for (const item of this.view.order()) {
      const value = valueAt(this.series(item), time);
      const far = Number.isFinite(value) ? Math.abs(u.valToPos(value, "y") - top) : Infinity;
      if (far < least) [found, least] = [item, far];
    }
    return found;
  }

  /** @param {any} u */
  #selected(u) {
    const { left, width } = u.select;
    if (width < 4) return;
    const range = [u.posToVal(left, "x"), u.posToVal(left + width, "x")];
    u.setSelect({ left: 0, width: 0, top: 0, height: 0 }, false);
    this.view.zoomTo(/** @type {[number, number]} */ (range));
  }

  /** @param {KeyboardEvent} event */
  #key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const { view } = this;
    const [from, to] = view.range();
    const time = view.time ?? (from + to) / 2;
    const step = ((to - from) / 400) * (event.shiftKey ? 10 : 1);
    const zoom = (/** @type {number} */ factor) => view.zoomTo([time - (time - from) * factor, time + (to - time) * factor]);
    if (event.key === "ArrowLeft") view.moveCursor(Math.max(from, time - step));
    else if (event.key === "ArrowRight") view.moveCursor(Math.min(to, time + step));
    else if (event.key === "+" || event.key === "=") zoom(0.5);
    else if (event.key === "-") zoom(2);
    else if (event.key === "Escape") view.zoomTo(null);
    else return;
    event.preventDefault();
  }
}
