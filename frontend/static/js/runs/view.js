// @ts-check

export const PAGE = 100;
const KEYS = ["columns", "where", "q", "sort", "order", "shelf", "page"];
// parameters of addresses of earlier versions, and the conditions that they stand for
const EARLIER = [["state", "state="], ["template", "template="], ["submitted_by", "submitted_by~"], ["since", "submitted_at>="], ["until", "submitted_at<="]];
/** @type {Record<string, string>} */
const DEFAULTS = { columns: "", where: "", q: "", sort: "number", order: "desc", shelf: "shown", page: "1" };

/** What the run table shows: columns, filter, order, shelf and page. Its query restores it exactly. */
export class View {
  /** @param {string} query */
  constructor(query) {
    const given = new URLSearchParams(query);
    /** @type {Record<string, string>} */
    this.values = Object.fromEntries(KEYS.map((key) => [key, given.get(key) || DEFAULTS[key]]));
    const earlier = EARLIER.flatMap(([name, start]) => (given.get(name) ? [`${start}${quoted(given.get(name) ?? "")}`] : []));
    this.values.where = [...split(this.values.where), ...earlier].join(";");
  }

  /** @returns {string[]} the keys of the columns; empty: the default columns */
  get columns() {
    return this.values.columns.split(",").filter(Boolean);
  }

  /** @returns {string[]} the conditions of the filter */
  get conditions() {
    return split(this.values.where);
  }

  get descending() {
    return this.values.order !== "asc";
  }

  get page() {
    return Math.max(1, Math.trunc(Number(this.values.page)) || 1);
  }

  /** Whether a filter, a search or a shelf hides runs. */
  get filtered() {
    return Boolean(this.values.where || this.values.q || this.values.shelf !== "shown");
  }

  /** A view with changes; it starts at the first page. @param {Record<string, string>} changes */
  with(changes) {
    const next = new View("");
    next.values = { ...this.values, page: "1", ...changes };
    return next;
  }

  /** The query of the address, without what is as by default. */
  get query() {
    const shown = KEYS.filter((key) => this.values[key] !== DEFAULTS[key]);
    return new URLSearchParams(shown.map((key) => [key, this.values[key]])).toString();
  }

  get address() {
    return this.query ? `/runs?${this.query}` : "/runs";
  }

  /** The query of a saved view: without the page. */
  get saved() {
    return this.with({}).query;
  }

  /** The query that the service reads for a page of the table. */
  get request() {
    return `${this.export}&limit=${PAGE}&offset=${PAGE * (this.page - 1)}`;
  }

  /** The query that the service reads for all rows. */
  get export() {
    const { page: _, ...asked } = this.values;
    return new URLSearchParams(asked).toString();
  }
}

/** The parts of a filter between semicolons that do not stand in quotation marks. @param {string} where @returns {string[]} */
export const split = (where) => (where.match(/(?:"(?:[^"]|"")*"|[^;"])+/g) ?? []).map((part) => part.trim()).filter(Boolean);

/** Column, operator and value of a condition. @param {string} condition */
export function parts(condition) {
  const found = /^([A-Za-z_][\w.:]*?)\s*(!=|>=|<=|!~|~|=|<|>)\s*(.*)$/s.exec(condition);
  return found ? { key: found[1], operator: found[2], value: found[3] } : { key: "", operator: "", value: condition };
}

/** A value as it stands in a filter. @param {string} value */
export const quoted = (value) => (/[;|"]/.test(value) ? `"${value.replaceAll('"', '""')}"` : value);
