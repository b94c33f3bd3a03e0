// @ts-check

/**
 * @typedef {{key: string, role: string, number: number | null, label: string, unit: string}} Channel
 * @typedef {{run: any, attempt: number, dt: number, bucket: number, buckets: number, channels: Channel[]}} Schema
 */

/** All buckets of a run: minimum, maximum and last sample of every channel, in arrays allocated once. */
export class Store {
  /** @param {Schema} schema */
  constructor(schema) {
    this.channels = schema.channels;
    this.buckets = schema.buckets;
    this.step = schema.bucket * schema.dt;
    this.count = 0;
    const column = () => new Float32Array(schema.buckets);
    this.min = schema.channels.map(column);
    this.max = schema.channels.map(column);
    this.last = schema.channels.map(column);
    this.lowest = new Float32Array(schema.channels.length).fill(Infinity);
    this.highest = new Float32Array(schema.channels.length).fill(-Infinity);
  }

  /** @param {string} key */
  index(key) {
    return this.channels.findIndex((channel) => channel.key === key);
  }

  /** The time at which bucket k ends (s). @param {number} k */
  time(k) {
    return (k + 1) * this.step;
  }

  get end() {
    return this.buckets * this.step;
  }

  /**
   * Store one binary frame. Known buckets are overwritten. Returns false if earlier buckets are missing.
   * @param {ArrayBuffer} frame
   */
  take(frame) {
    const [first, count] = new Uint32Array(frame, 0, 2);
    if (first > this.count) return false;
    const values = new Float32Array(frame, 8);
    const width = this.channels.length;
    const until = Math.min(first + count, this.buckets);
    for (let c = 0; c < width; c++) {
      const [min, max, last] = [this.min[c], this.max[c], this.last[c]];
      let [low, high] = [this.lowest[c], this.highest[c]];
      for (let k = first, i = 3 * c; k < until; k++, i += 3 * width) {
        min[k] = values[i];
        max[k] = values[i + 1];
        last[k] = values[i + 2];
        if (min[k] < low) low = min[k];
        if (max[k] > high) high = max[k];
      }
      this.lowest[c] = low;
      this.highest[c] = high;
    }
    this.count = Math.max(this.count, until);
    return true;
  }
}
