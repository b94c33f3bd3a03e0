// @ts-check
import { api, explain } from "../api.js";
import { byId, el } from "../dom.js";
import { act, askTags } from "./actions.js";
import { chooseColumns } from "./column_dialog.js";
import { editFilter, inWords } from "./filter_dialog.js";
import { Grid } from "./grid.js";
import { showHeads } from "./heads.js";
import { Panel } from "./panel.js";
import { savedViews } from "./saved_views.js";
import { PAGE, View, parts } from "./view.js";

/** @typedef {import("./cells.js").Column} Column */

const POLL_MS = 5000;
const TYPED_MS = 250;
let view = new View(location.search);
/** @type {Column[]} */
let columns = [];
/** @type {Map<string, Column>} */
let known = new Map();
/** @type {string[]} */
let tags = [];
let last = "";
let turn = 0;

const panel = new Panel({ tags: () => tags, changed: () => void reload(), archive: (run) => act(run.archived ? "unarchive" : "archive", [run], reload), remove: (run) => act("delete", [run], reload) });
const grid = new Grid({ focused: (row, asked) => panel.show(row, asked), selected: showSelection });

/** Show another view and store it in the address. @param {Record<string, string>} changes */
function change(changes) {
  view = view.with(changes);
  history.pushState(null, "", view.address);
  void reload();
}

async function reload() {
  const mine = ++turn;
  try {
    const table = await api.get(`/runs/table?${view.request}`);
    if (mine !== turn) return;
    byId("problem").hidden = true;
    const text = JSON.stringify([table, view.address]);
    if (text !== last) show(table);
    last = text;
  } catch (error) {
    if (mine !== turn) return;
    last = "";
    byId("problem").hidden = false;
    byId("problem").textContent = explain(error);
    showFilters();
  }
}

/** @param {any} table */
function show(table) {
  columns = table.columns;
  for (const one of columns) known.set(one.key, one);
  showHeads(columns, view, {
    sort: (key, descending) => change({ sort: key, order: descending ? "desc" : "asc" }),
    filter: (column) => edit(column, ""),
    order: (keys) => change({ columns: keys.join(",") }),
  });
  grid.show(columns, table.rows);
  if (grid.current) panel.show(grid.rows[grid.index], false);
  else panel.clear();
  showFilters();
  showCount(table);
  showSelection();
  showViews?.();
}

/** @param {any} table */
function showCount({ rows, total, exact }) {
  const first = PAGE * (view.page - 1);
  byId("count").textContent = rows.length ? `${first + 1} to ${first + rows.length} of ${exact ? "" : "more than "}${total} runs` : "";
  const link = (/** @type {number} */ page, /** @type {string} */ label, /** @type {string} */ rel) =>
    el("a", { href: view.with({ page: String(page) }).address, rel, on: { click: (/** @type {Event} */ event) => {
      event.preventDefault();
      change({ page: String(page) });
      byId("table").scrollTop = 0;
    } } }, label);
  byId("turn").replaceChildren(
    ...(view.page > 1 ? [link(view.page - 1, "Previous page", "prev")] : []),
    ...(rows.length === PAGE && (!exact || first + PAGE < total) ? [link(view.page + 1, "Next page", "next")] : []),
  );
  byId("table").hidden = !rows.length;
  byId("empty").hidden = rows.length > 0;
  byId("panel").hidden = !rows.length;
  byId("empty").replaceChildren(...empty(total));
}

/** @param {number} total */
function empty(total) {
  if (total) return [`Page ${view.page} is empty: there are only ${total} runs. `, el("a", { href: view.with({}).address }, "Go to the first page"), "."];
  if (view.filtered) return ["No run matches this filter. ", el("a", { href: "/runs" }, "Show all runs"), "."];
  return ["There is no run yet. Each test that you queue appears here. ", el("span", { "data-needs": "operator" }, el("a", { href: "/new" }, "Set up the first test"), ".")];
}

function showFilters() {
  const conditions = view.conditions;
  const without = (/** @type {number} */ at) => change({ where: conditions.toSpliced(at, 1).join(";") });
  byId("filters").replaceChildren(...conditions.map((condition, at) => {
    const column = known.get(parts(condition).key === "tag" ? "tags" : parts(condition).key);
    const words = inWords(condition, known);
    return el("span", { class: "chip" },
      el("button", { type: "button", class: "chip-edit", title: condition, disabled: !column, on: { click: () => column && edit(column, condition, at) } }, words),
      el("button", { type: "button", class: "chip-remove", "aria-label": `Remove filter: ${words}`, on: { click: () => without(at) } }, "✕"));
  }));
  if (document.activeElement !== byId("search")) byId("search").value = view.values.q;
  byId("shelf").value = view.values.shelf;
  byId("export").href = `/api/v1/runs/table.csv?${view.export}`;
}

/** @param {Column} column @param {string} condition @param {number} [at] */
function edit(column, condition, at) {
  editFilter(column, condition, tags, (next) => {
    const conditions = view.conditions;
    change({ where: (at === undefined ? [...conditions, next] : conditions.with(at, next)).join(";") });
  });
}

function showSelection() {
  const chosen = [...grid.selection.values()];
  const deleted = view.values.shelf === "deleted";
  byId("selection").hidden = !chosen.length;
  byId("selected").textContent = `${chosen.length} ${chosen.length === 1 ? "run" : "runs"} selected`;
  const button = (/** @type {string} */ label, /** @type {() => void} */ act) => el("button", { type: "button", class: "quiet small", "data-needs": "engineer", on: { click: act } }, label);
  const archived = view.values.shelf === "archived";
  const items = chosen.map((run) => `run:${run.id}`).join(",");
  byId("bulk").replaceChildren(...(deleted
    ? [button("Restore runs", () => act("restore", chosen, done))]
    : [
        ...(chosen.length > 1 && chosen.length <= 20 ? [el("a", { class: "button small", href: `/compare?items=${items}` }, "Compare runs")] : []),
        button("Add tags", () => askTags(chosen, "tag", reload)),
        button("Remove tags", () => askTags(chosen, "untag", reload)),
        button(archived ? "Unarchive runs" : "Archive runs", () => act(archived ? "unarchive" : "archive", chosen, done)),
        button("Delete runs", () => act("delete", chosen, done)),
      ]), el("button", { type: "button", class: "quiet small", on: { click: () => grid.clear() } }, "Clear selection"));
}

/** After runs have left the list. */
async function done() {
  grid.clear();
  panel.id = "";
  await reload();
}

/** @type {(() => void) | undefined} */
let showViews;
/** @type {ReturnType<typeof setTimeout>} */
let typing;

byId("search").addEventListener("input", () => {
  clearTimeout(typing);
  typing = setTimeout(() => {
    view = view.with({ q: byId("search").value.trim() });
    history.replaceState(null, "", view.address); // one entry of the history for a whole search
    void reload();
  }, TYPED_MS);
});
byId("shelf").addEventListener("change", () => {
  grid.clear();
  change({ shelf: byId("shelf").value });
});
byId("choose-columns").addEventListener("click", async () => {
  await ready;
  chooseColumns([...known.values()], columns.map((one) => one.key), (keys) => keys.length && change({ columns: keys.join(",") }));
});
byId("add-filter").addEventListener("click", async () => {
  await ready;
  const select = byId("filter-column");
  select.replaceChildren(...[...known.values()].map((one) => el("option", { value: one.heading }, one.key)));
  byId("add-filter-input").value = "";
  byId("add-filter-dialog").showModal();
});
byId("add-filter-form").addEventListener("submit", () => {
  const typed = byId("add-filter-input").value.trim();
  const column = [...known.values()].find((one) => one.heading === typed || one.key === typed);
  if (column) edit(column, "");
  else if (parts(typed).key) change({ where: [...view.conditions, typed].join(";") });
});
addEventListener("keydown", (event) => {
  const typing = event.target instanceof HTMLElement && event.target.matches("input, textarea, select");
  if (event.key === "/" && !typing && !document.querySelector("dialog[open]")) {
    event.preventDefault();
    byId("search").focus();
  }
});
byId("search").addEventListener("keydown", (/** @type {KeyboardEvent} */ event) => {
  if (event.key === "ArrowDown") grid.focus(grid.index);
});
for (const button of document.querySelectorAll("dialog [data-close]")) button.addEventListener("click", () => button.closest("dialog")?.close());
addEventListener("popstate", () => {
  view = new View(location.search);
  void reload();
});
setInterval(() => document.visibilityState === "visible" && !document.querySelector("dialog[open], :popover-open") && !byId("panel").contains(document.activeElement) && void reload(), POLL_MS);

/** Load the catalogue of columns, the tags and the saved views. */
async function load() {
  const views = savedViews(() => view, (query) => {
    view = new View(query);
    history.pushState(null, "", view.address);
    void reload();
  });
  try {
    const [all, some] = await Promise.all([api.get("/runs/columns"), api.get("/runs/tags")]);
    known = new Map([...all.columns.map((/** @type {Column} */ one) => [one.key, one]), ...known]);
    tags = some.tags;
    byId("known-tags").replaceChildren(...tags.map((tag) => el("option", { value: tag })));
    showViews = await views;
    showFilters();
  } catch (error) {
    byId("problem").hidden = false;
    byId("problem").textContent = explain(error);
  }
}

const ready = load();
void reload();
