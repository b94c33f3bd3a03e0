// @ts-check
/** @typedef {import("./store.js").Store} Store */

/** @typedef {{visible: boolean, draw: () => void, readout: () => void}} Drawable */

const READOUT_MS = 200;

/** The shared state of all charts: the data, the shown time range, and one redraw for each animation frame. */
export class View {
  /** @param {Store} store */
  constructor(store) {
    this.store = store;
    /** @type {Drawable[]} */
    this.charts = [];
    /** @type {[number, number] | null} the zoomed range */
    this.zoom = null;
    /** @type {number | null} length of the window that follows the newest data (s); null shows the whole test */
    this.window = null;
    this.frame = 0;
    this.lastReadout = -Infinity;
    this.observer = new IntersectionObserver((entries) => entries.forEach((entry) => this.#seen(entry)), { rootMargin: "80px" });
    /** @type {Map<Element, Drawable>} */
    this.byElement = new Map();
  }

  /** @param {Element} element @param {Drawable} chart */
  add(element, chart) {
    this.charts.push(chart);
    this.byElement.set(element, chart);
    this.observer.observe(element);
  }

  /** The shown time range (s). @returns {[number, number]} */
  range() {
    if (this.zoom) return this.zoom;
    if (this.window === null) return [0, this.store.end];
    const now = Math.max(this.store.count * this.store.step, this.window);
    return [now - this.window, now];
  }

  /** @param {[number, number] | null} range */
  zoomTo(range) {
    this.zoom = range;
    this.redraw();
  }

  /** Draw the visible charts at the next animation frame. Further calls before that frame have no effect. */
  redraw() {
    this.frame ||= requestAnimationFrame((now) => {
      this.frame = 0;
      for (const chart of this.charts) if (chart.visible) chart.draw();
      if (now - this.lastReadout >= READOUT_MS) this.#readout(now);
      else this.late ||= setTimeout(() => this.#readout(performance.now()), READOUT_MS);
    });
  }

  /** @param {number} now */
  #readout(now) {
    clearTimeout(this.late);
    this.late = 0;
    this.lastReadout = now;
    for (const chart of this.charts) chart.readout();
  }

  /** @type {number} */
  late = 0;

  /** @param {IntersectionObserverEntry} entry */
  #seen(entry) {
    const chart = this.byElement.get(entry.target);
    if (!chart) return;
    chart.visible = entry.isIntersecting;
    if (chart.visible) this.redraw();
  }

  close() {
    cancelAnimationFrame(this.frame);
    clearTimeout(this.late);
    this.observer.disconnect();
  }
}
