// @ts-check
/** @typedef {import("./store.js").Store} Store */

/**
 * Something that the view draws: `draw` after new data or another time range, `follow` after another moment only, and `readout`
 * changes the numbers. `resize` fits it to its box where a size does not follow from drawing.
 * @typedef {{visible: boolean, draw: () => void, follow: () => void, readout: () => void, resize?: () => void}} Drawable
 */

const READOUT_MS = 120;
const SPARE = 0.02; // of what ran: room after it, so that the mark of a trip is not on the edge

/** The shared state of all charts: the data, the shown time range, the shown moment, and one redraw for each animation frame. */
export class View {
  /** @param {Store} store */
  constructor(store) {
    this.store = store;
    /** @type {Drawable[]} */
    this.charts = [];
    /** @type {[number, number] | null} the zoomed range */
    this.zoom = null;
    /** @type {number | null} length of the window that follows the shown moment (s); null shows the whole test */
    this.window = null;
    /** @type {number | null} the moment of the replay (s); null follows the newest sample */
    this.head = null;
    /** @type {number | null} the time under the cursor (s) */
    this.cursor = null;
    this.ended = false;
    /** @type {any} the trip that ended the test */
    this.trip = null;
    /** @type {import("./annotations.js").Note[]} */
    this.notes = [];
    /** @type {(() => void) | null} called when the shown moment changes */
    this.moved = null;
    this.frame = 0;
    this.stale = false;
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

  /** @param {Element} element */
  remove(element) {
    const gone = this.byElement.get(element);
    this.observer.unobserve(element);
    this.byElement.delete(element);
    this.charts = this.charts.filter((chart) => chart !== gone);
  }

  /** The end of the time axis (s): the planned end of a test, and what ran once it has ended. */
  get end() {
    if (!this.ended || !this.store.count) return this.store.end;
    return this.store.count < this.store.buckets ? Math.max(this.store.now, this.trip?.time_s ?? 0) * (1 + SPARE) : this.store.now;
  }

  /** The shown time range (s). @returns {[number, number]} */
  range() {
    if (this.zoom) return this.zoom;
    if (this.window === null) return [0, this.end];
    const now = Math.max(this.until(), this.window);
    return [now - this.window, now];
  }

  /** The time up to which the test is shown (s): the moment of the replay, or the newest sample. */
  until() {
    return this.head ?? this.store.now;
  }

  /** The time at the head of the loops (s): under the cursor, else `until`. */
  pointed() {
    return this.cursor ?? this.until();
  }

  /**
   * The time that gauges and the drawing show (s). They follow the cursor only after the test: while it runs, a pointer that rests
   * on a chart must not hide the present values.
   */
  shown() {
    return this.ended ? this.pointed() : this.until();
  }

  /** @param {[number, number] | null} range */
  zoomTo(range) {
    this.zoom = range;
    this.redraw();
  }

  /** Show the test at a time, or at its newest sample (null). @param {number | null} time */
  seek(time) {
    this.head = time;
    if (this.window !== null && !this.zoom) this.redraw();
    else this.follow();
    this.moved?.();
  }

  /** @param {number | null} time */
  point(time) {
    if (time === this.cursor) return;
    this.cursor = time;
    this.follow();
  }

  /** Draw the visible charts anew at the next animation frame. Further calls before that frame have no effect. */
  redraw() {
    this.stale = true;
    this.follow();
  }

  /** Show another moment at the next animation frame. */
  follow() {
    this.frame ||= requestAnimationFrame((now) => {
      this.frame = 0;
      const { stale } = this;
      this.stale = false;
      for (const chart of this.charts) if (chart.visible) stale ? chart.draw() : chart.follow();
      if (now - this.lastReadout >= READOUT_MS) this.#readout(now);
      else this.late ||= setTimeout(() => this.#readout(performance.now()), READOUT_MS);
    });
  }

  /** Draw every chart now at the size of its box, seen or not, as for a print. */
  drawAll() {
    for (const chart of this.charts) {
      chart.resize?.();
      chart.draw();
    }
    this.#readout(performance.now());
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
