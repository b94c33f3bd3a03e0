// @ts-check
import { Signals } from "./signals.js";

/** @typedef {[number, number]} Range @typedef {{visible: boolean, draw: () => void, cursor: () => void}} Drawable */

/** The shared state of all charts of a comparison: signals, time range, cursor, shown and highlighted items. */
export class View {
  /** @param {number} items @param {number} reference */
  constructor(items, reference) {
    this.items = items;
    this.reference = reference;
    this.whole = /** @type {Range} */ ([0, 1]);
    /** @type {Range | null} */
    this.zoom = null;
    this.overview = new Signals([]);
    /** @type {{range: Range, signals: Signals} | null} the signals of a zoomed range, with more samples than the overview */
    this.detail = null;
    /** @type {number | null} time of the cursor (s) */
    this.time = null;
    /** @type {number | null} */
    this.highlighted = null;
    /** whether the other items fade much, as while a row of the legend is pointed at */
    this.alone = false;
    /** @type {{role: string, title: string} | null} the chart whose values the legend shows */
    this.asked = null;
    this.hidden = new Set();
    /** @type {Drawable[]} */
    this.charts = [];
    /** @type {(() => void)[]} */
    this.watchers = [];
    this.frame = 0;
    this.stale = false;
    /** @type {Map<Element, Drawable>} */
    this.byElement = new Map();
    this.observer = new IntersectionObserver((entries) => entries.forEach((entry) => this.#seen(entry)), { rootMargin: "120px" });
  }

  /** @param {Element} element @param {Drawable} chart */
  add(element, chart) {
    this.charts.push(chart);
    this.byElement.set(element, chart);
    this.observer.observe(element);
  }

  /** Remove all charts. */
  clear() {
    this.observer.disconnect();
    this.charts = [];
    this.byElement.clear();
  }

  /** Show the values of a chart in the legend. @param {{role: string, title: string}} chart */
  ask(chart) {
    this.asked = chart;
  }

  /** The shown time range (s). @returns {Range} */
  range() {
    return this.zoom ?? this.whole;
  }

  /** The signals with the most samples in the shown range. */
  get signals() {
    const [from, to] = this.range();
    const inside = this.detail && from >= this.detail.range[0] - 1e-9 && to <= this.detail.range[1] + 1e-9;
    return this.detail && inside ? this.detail.signals : this.overview;
  }

  /** The shown items in the order in which they are drawn: the reference and the highlighted item last. */
  order() {
    const rank = (/** @type {number} */ item) => (item === this.highlighted ? 2 : item === this.reference ? 1 : 0);
    const shown = Array.from({ length: this.items }, (_, item) => item).filter((item) => !this.hidden.has(item));
    return shown.sort((a, b) => rank(a) - rank(b) || a - b);
  }

  /** Show a part of the time, or all of it. @param {Range | null} range */
  zoomTo(range) {
    const [from, to] = this.whole;
    this.zoom = range && [Math.max(from, range[0]), Math.min(to, range[1])];
    if (this.zoom && this.zoom[1] - this.zoom[0] >= 0.999 * (to - from)) this.zoom = null;
    this.changed();
  }

  /** @param {number | null} time */
  moveCursor(time) {
    this.time = time;
    this.changed(false);
  }

  /** Draw an item above the others, which fade: a little, or much with `alone`. @param {number | null} item @param {boolean} [alone] */
  highlight(item, alone = false) {
    if (this.highlighted === item && this.alone === alone) return;
    this.highlighted = item;
    this.alone = alone;
    this.changed();
  }

  /** @param {number} item @param {boolean} shown */
  show(item, shown) {
    if (shown) this.hidden.delete(item);
    else this.hidden.add(item);
    this.changed();
  }

  /** Draw the visible charts at the next animation frame, or only their cursors, and tell the watchers. @param {boolean} [curves] */
  changed(curves = true) {
    this.stale ||= curves;
    this.frame ||= requestAnimationFrame(() => {
      this.frame = 0;
      if (this.stale) for (const chart of this.charts) if (chart.visible) chart.draw();
      this.stale = false;
      for (const chart of this.charts) if (chart.visible) chart.cursor();
      for (const watcher of this.watchers) watcher();
    });
  }

  /** @param {IntersectionObserverEntry} entry */
  #seen(entry) {
    const chart = this.byElement.get(entry.target);
    if (!chart) return;
    chart.visible = entry.isIntersecting;
    if (chart.visible) this.changed();
  }
}
