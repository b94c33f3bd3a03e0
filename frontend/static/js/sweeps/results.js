// @ts-check

/**
 * @typedef {{key: string, label: string, shown: string, shown_label: string, role: "input" | "intensity" | "outcome" | "measure", scope: string, number: number | null, name: string, measure: string, decimals: number | null, categories: string[]}} Column
 * @typedef {string | number | null} Cell
 */

/** The results of a sweep in columns, with the filters of the reader. */
export class Results {
  /** @type {Record<string, Cell[]>} */
  values = { point: [], reason: [] };
  /** ranges that points must lie in, by column @type {Map<string, [number, number]>} */
  ranges = new Map();
  status = "";
  sort = "point";
  descending = false;

  /** @param {Column[]} columns */
  constructor(columns) {
    this.columns = columns;
  }

  get size() {
    return this.values.point.length;
  }

  /** @param {string} key @returns {Column} */
  column(key) {
    const found = this.columns.find((one) => one.key === key);
    if (!found) throw new Error(`The sweep has no column ${key}.`);
    return found;
  }

  /** The columns of numbers with these roles that have at least one value. @param {...string} roles */
  numbers(...roles) {
    return this.columns.filter(({ key, role, categories }) => roles.includes(role) && !categories.length && this.values[key]?.some((value) => value !== null));
  }

  /** A value as a number: places of a text in the categories of its column; NaN where there is none. @param {string} key @param {number} row */
  number(key, row) {
    const value = this.values[key][row];
    if (value === null || value === undefined) return NaN;
    return typeof value === "number" ? value : this.column(key).categories.indexOf(value);
  }

  /** The rows that pass the filters, in the chosen order; rows without a value come last. */
  rows() {
    const passed = Array.from({ length: this.size }, (_, row) => row).filter((row) => this.passes(row));
    const sign = this.descending ? -1 : 1;
    const by = this.sort === "point" ? (/** @type {number} */ row) => Number(this.values.point[row]) : (/** @type {number} */ row) => this.number(this.sort, row);
    return passed.sort((a, b) => {
      const [x, y] = [by(a), by(b)];
      if (Number.isNaN(x) || Number.isNaN(y)) return Number(Number.isNaN(x)) - Number(Number.isNaN(y));
      return sign * (x - y) || a - b;
    });
  }

  /** @param {number} row */
  passes(row) {
    if (this.status && this.values.status[row] !== this.status) return false;
    for (const [key, [low, high]] of this.ranges) {
      const value = this.number(key, row);
      if (!(value >= low && value <= high)) return false;
    }
    return true;
  }
}

/** Label with unit. @param {Column} column */
export const titled = ({ label, shown_label }) => (shown_label ? `${label}, ${shown_label}` : label);

/** Label with unit, without the parts between the first and the last: `Station 1: Delay constant`. @param {Column} column */
export function brief({ label, shown_label }) {
  const parts = label.split(": ");
  const text = parts.length > 2 ? `${parts[0]}: ${parts[parts.length - 1]}` : label;
  return shown_label ? `${text}, ${shown_label}` : text;
}

/** A value with three significant digits. @param {Cell | undefined} value */
export function digits(value) {
  if (value === null || value === undefined || value === "") return "–";
  if (typeof value === "string") return value;
  if (value === 0 || !Number.isFinite(value)) return value === 0 ? "0" : "–";
  const size = Math.abs(value);
  if (size >= 1e6 || size < 1e-4) return value.toExponential(2);
  return size >= 1000 ? String(Number(value.toPrecision(3))) : value.toPrecision(3);
}
