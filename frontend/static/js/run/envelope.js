// @ts-check
import { extremes } from "./store.js";

/** @typedef {import("./store.js").Store} Store */

/**
 * The signals reduced to a chart's pixels: the minimum and maximum of each pixel column, in their order in time. A column without
 * any finite sample is a gap: uPlot takes only null for a missing value, so a series with a gap becomes a plain array.
 */
export class Envelope {
  /** @param {number} series */
  constructor(series) {
    this.points = 0;
    this.dense = false; // whether a column holds several buckets
    this.time = new Float64Array(0);
    this.values = Array.from({ length: series }, () => new Float32Array(0));
    /** @type {(Float64Array | Float32Array | (number | null)[])[]} */
    this.views = [];
  }

  /**
   * Fill with the buckets between two times, in at most `columns` columns; `points` holds the number of points.
   * @param {Store} store @param {number[]} channels @param {number} from @param {number} to @param {number} columns
   */
  fill(store, channels, from, to, columns) {
    this.#reserve(2 * columns + 8);
    const first = Math.max(0, Math.floor(from / store.step) - 1);
    const end = Math.min(store.count, Math.ceil(to / store.step) + 1);
    const width = Math.max(1, Math.ceil((to - from) / store.step / columns));
    this.dense = width > 1;
    const used = Math.max(0, Math.ceil((end - first) / width));
    for (let column = 0; column < used; column++) {
      const upper = Math.min(first + (column + 1) * width, end);
      this.time[2 * column] = (upper - width / 2) * store.step;
      this.time[2 * column + 1] = upper * store.step;
    }
    this.points = 2 * used;
    this.views = [
      this.time.subarray(0, this.points),
      ...channels.map((channel, series) => {
        const whole = this.#column(store, channel, this.values[series], first, end, width);
        const values = this.values[series].subarray(0, this.points);
        return whole ? values : Array.from(values, (value) => (Number.isFinite(value) ? value : null));
      }),
    ];
  }

  /** Fill one series; returns whether every column has a finite sample. @param {Store} store @param {number} channel @param {Float32Array} out @param {number} first @param {number} end @param {number} width */
  #column(store, channel, out, first, end, width) {
    const [min, max, last] = [store.min[channel], store.max[channel], store.last[channel]];
    let whole = true;
    for (let start = first, i = 0; start < end; start += width, i += 2) {
      const upper = Math.min(start + width, end);
      const [low, high] = extremes(min, max, start, upper);
      const missing = !(high >= low);
      const rising = last[upper - 1] - low > high - last[upper - 1];
      out[i] = missing ? NaN : rising ? low : high;
      out[i + 1] = missing ? NaN : rising ? high : low;
      if (missing) whole = false;
    }
    return whole;
  }

  /** @param {number} size */
  #reserve(size) {
    if (this.time.length >= size) return;
    this.time = new Float64Array(size);
    this.values = this.values.map(() => new Float32Array(size));
  }
}
