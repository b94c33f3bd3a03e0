// @ts-check

/**
 * `factor` is the SI value of one shown unit.
 * @typedef {{key: string, role: string, number: number | null, label: string, unit: string, factor: number}} Channel
 * @typedef {{run: any, attempt: number, dt: number, bucket: number, buckets: number, channels: Channel[], open_ended?: boolean}} Schema
 */

/**
 * All channels at one time of a test, and their smallest and largest values from its start to that time. `time` is null before
 * the first sample.
 * @typedef {{time: number | null, values: Float32Array, lowest: Float32Array, highest: Float32Array}} Moment
 */

const SHORTEST_S = 10; // first time axis of a test whose length is not known
const BLOCK = 64; // buckets between two stored extremes so far

/** All buckets of a run: minimum, maximum and last sample of every channel, in arrays allocated once. */
export class Store {
  /** @param {Schema} schema */
  constructor(schema) {
    this.channels = schema.channels;
    this.buckets = schema.buckets;
    this.openEnded = schema.open_ended ?? false;
    this.step = schema.bucket * schema.dt;
    this.count = 0;
    const column = () => new Float32Array(schema.buckets);
    this.min = schema.channels.map(column);
    this.max = schema.channels.map(column);
    this.last = schema.channels.map(column);
    this.lowest = new Float32Array(schema.channels.length).fill(Infinity);
    this.highest = new Float32Array(schema.channels.length).fill(-Infinity);
    const blocks = Math.ceil(schema.buckets / BLOCK);
    this.lowestUntil = schema.channels.map(() => new Float32Array(blocks));
    this.highestUntil = schema.channels.map(() => new Float32Array(blocks));
    this.blocks = 0;
    this.shown = moment(schema.channels.length);
  }

  /** @param {string} key */
  index(key) {
    return this.channels.findIndex((channel) => channel.key === key);
  }

  /** The time at which bucket k ends (s). @param {number} k */
  time(k) {
    return (k + 1) * this.step;
  }

  /** The bucket that is shown for a time (s); -1 if there is no data. @param {number} time */
  at(time) {
    return Math.min(this.count, Math.max(1, Math.round(time / this.step))) - 1;
  }

  /** The end of the time axis (s): that of the test, or, where that is not known, the least of 10, 20, 40 … s that holds all samples. */
  get end() {
    const longest = this.buckets * this.step;
    return this.openEnded ? Math.min(longest, SHORTEST_S * 2 ** Math.ceil(Math.log2(Math.max(1, this.now / SHORTEST_S)))) : longest;
  }

  /** The time of the newest sample (s). */
  get now() {
    return this.count * this.step;
  }

  /** The test at a time (s), or at its newest sample. The same object is filled anew by every call. @param {number | null} [time] @returns {Moment} */
  moment(time = null) {
    const { values, lowest, highest } = this.shown;
    const k = this.at(time ?? Infinity);
    this.shown.time = k < 0 ? null : this.time(k);
    for (let c = 0; c < values.length; c++) values[c] = k < 0 ? NaN : this.last[c][k];
    if (k === this.count - 1) {
      lowest.set(this.lowest);
      highest.set(this.highest);
    } else this.#until(k);
    return this.shown;
  }

  /** Fill the extremes from the start up to bucket k. @param {number} k */
  #until(k) {
    for (; this.blocks < Math.floor(this.count / BLOCK); this.blocks++) this.#block(this.blocks);
    const whole = Math.min(this.blocks, Math.floor((k + 1) / BLOCK));
    for (let c = 0; c < this.channels.length; c++) {
      let low = whole ? this.lowestUntil[c][whole - 1] : Infinity;
      let high = whole ? this.highestUntil[c][whole - 1] : -Infinity;
      [low, high] = extremes(this.min[c], this.max[c], whole * BLOCK, k + 1, low, high);
      this.shown.lowest[c] = low;
      this.shown.highest[c] = high;
    }
  }

  /** @param {number} block */
  #block(block) {
    for (let c = 0; c < this.channels.length; c++) {
      const low = block ? this.lowestUntil[c][block - 1] : Infinity;
      const high = block ? this.highestUntil[c][block - 1] : -Infinity;
      const found = extremes(this.min[c], this.max[c], block * BLOCK, (block + 1) * BLOCK, low, high);
      [this.lowestUntil[c][block], this.highestUntil[c][block]] = found;
    }
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
      for (let k = first, i = 3 * c; k < until; k++, i += 3 * width) {
        min[k] = values[i];
        max[k] = values[i + 1];
        last[k] = values[i + 2];
      }
      [this.lowest[c], this.highest[c]] = extremes(min, max, first, until, this.lowest[c], this.highest[c]);
    }
    this.count = Math.max(this.count, until);
    return true;
  }
}

/** A moment before the first sample, such as a queued test. @param {number} channels @returns {Moment} */
export const moment = (channels) => ({
  time: null,
  values: new Float32Array(channels).fill(NaN),
  lowest: new Float32Array(channels).fill(Infinity),
  highest: new Float32Array(channels).fill(-Infinity),
});

/**
 * The smallest minimum and the largest maximum of buckets [from, to). A missing sample, which is not a finite number, is left out.
 * @param {Float32Array} min @param {Float32Array} max @param {number} from @param {number} to @param {number} low @param {number} high @returns {[number, number]}
 */
export function extremes(min, max, from, to, low = Infinity, high = -Infinity) {
  for (let k = from; k < to; k++) {
    if (min[k] < low && min[k] > -Infinity) low = min[k];
    if (max[k] > high && max[k] < Infinity) high = max[k];
  }
  return [low, high];
}
