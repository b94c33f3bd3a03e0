// @ts-check
import { api } from "../api.js";
import { byId, el } from "../dom.js";
import { withinLimit } from "../limit.js";
import { person } from "../person.js";
import { showDrafts } from "./draft_rows.js";
import { attempt, notice } from "./notice.js";
import { planRow } from "./plan_rows.js";
import { tableOf } from "./words.js";

const LIMIT = 50;
const QUIET_MS = 250;
const HEADS = ["Plan", "Newest version", "Kind of test", "Author", "Changed", "#Runs", "#Drafts", ""];

/** The filter that the address holds: an address is a view that can be kept and sent. */
const view = new URLSearchParams(location.search);
const text = byId("find");
const tag = byId("tag");
const archived = byId("archived");
const sort = byId("sort");
let typing = 0;

/** @param {Record<string, string>} changes */
async function look(changes) {
  if (!("page" in changes)) view.delete("page");
  for (const [name, value] of Object.entries(changes)) {
    if (value) view.set(name, value);
    else view.delete(name);
  }
  history.replaceState(null, "", `/plans${view.size ? `?${view}` : ""}`);
  await attempt(showPlans);
}

async function showPlans() {
  const page = Math.max(1, Number(view.get("page")) || 1);
  const [key, order] = (view.get("sort") ?? "changed_at desc").split(" ");
  const query = new URLSearchParams({ q: view.get("q") ?? "", tag: view.get("tag") ?? "", archived: String(view.has("archived")) });
  for (const [name, value] of Object.entries({ sort: key, order: order ?? "desc", limit: LIMIT, offset: LIMIT * (page - 1) })) query.set(name, String(value));
  const { plans, total, tags } = await api.get(`/library/plans?${query}`);
  offerTags(tags);
  const rows = plans.map((/** @type {any} */ plan) => planRow(plan, showPlans, (one) => void look({ tag: one })));
  byId("plans").replaceChildren(...(rows.length ? [tableOf("Plans in the library", HEADS, rows), pages(page, rows.length, total)] : [nothing()]));
}

/** @param {{tag: string, plans: number}[]} tags */
function offerTags(tags) {
  const chosen = view.get("tag") ?? "";
  const known = tags.some((one) => one.tag === chosen) || !chosen ? tags : [...tags, { tag: chosen, plans: 0 }];
  tag.replaceChildren(el("option", { value: "" }, "any"), ...known.map((one) => el("option", { value: one.tag }, `${one.tag} (${one.plans})`)));
  tag.value = chosen;
}

function nothing() {
  if (view.get("q") || view.get("tag")) return el("p", { class: "empty" }, "No plan matches this filter.");
  if (view.has("archived")) return el("p", { class: "empty" }, "No plan is archived. A plan that you archive leaves the list and appears here.");
  const words = "Plans appear here when you save them: set up a test and press ";
  return el("p", { class: "empty" }, "There is no plan in the library yet. ", el("span", { "data-needs": "engineer" }, words, el("a", { href: "/new" }, "Save to the library"), ", or import a plan from YAML."));
}

/** @param {number} page @param {number} shown @param {number} total */
function pages(page, shown, total) {
  const first = LIMIT * (page - 1) + 1;
  const go = (/** @type {number} */ to, /** @type {string} */ words) => el("button", { type: "button", class: "quiet small", on: { click: () => look({ page: String(to) }) } }, words);
  return el(
    "nav",
    { class: "pages", "aria-label": "Pages of the list" },
    el("span", {}, `${first} to ${first + shown - 1} of ${total}`),
    page > 1 && go(page - 1, "Previous page"),
    first + shown - 1 < total && go(page + 1, "Next page"),
  );
}

/** Keep a plan from a YAML file in the library. @param {HTMLInputElement} input */
async function importFile(input) {
  const text = await withinLimit(/** @type {FileList} */ (input.files)[0]).text();
  input.value = "";
  const saved = await api.postText(`/library/import?saved_by=${encodeURIComponent(person())}`, text, "application/yaml");
  await showPlans();
  notice(`Imported as ${saved.name}.`);
}

text.value = view.get("q") ?? "";
archived.checked = view.has("archived");
sort.value = view.get("sort") ?? "changed_at desc";
text.addEventListener("input", () => {
  clearTimeout(typing);
  typing = setTimeout(() => look({ q: text.value.trim() }), QUIET_MS);
});
tag.addEventListener("change", () => look({ tag: tag.value }));
archived.addEventListener("change", () => look({ archived: archived.checked ? "yes" : "" }));
sort.addEventListener("change", () => look({ sort: sort.value === "changed_at desc" ? "" : sort.value }));
byId("filter").addEventListener("submit", (/** @type {Event} */ event) => event.preventDefault());
byId("import").addEventListener("change", (/** @type {any} */ event) => attempt(() => importFile(event.target)));
attempt(() => showDrafts(byId("drafts")));
attempt(showPlans);
