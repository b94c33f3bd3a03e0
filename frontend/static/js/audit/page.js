// @ts-check
// The audit log: newest entries first, filtered and paged by the address of the page; the state of its chain.
import { api, explain } from "../api.js";
import { byId, el } from "../dom.js";
import { when } from "../format.js";
import { facts, line } from "./words.js";

/** @typedef {import("./words.js").Entry} Entry */

const NARROW = "(max-width: 760px)"; // css/audit.css shows entries as cards
const LIMIT = matchMedia(NARROW).matches ? 20 : 50;
const CHECKED_AT_ONCE = 20_000; // entries; a longer chain is checked when asked for
const FIELDS = ["who", "action", "run", "since", "until"];
const form = byId("filter");
const asked = new URLSearchParams(location.search);
const offset = () => Number(asked.get("offset") ?? 0) || 0;

/** @param {Entry} entry */
function row(entry) {
  const names = (/** @type {[string, string]} */ [name, value]) => [
    el("dt", {}, name),
    el("dd", { class: name.startsWith("hash") ? "hash" : "" }, value),
  ];
  return el(
    "tr",
    {},
    el("td", { class: "number entry" }, String(entry.number)),
    el("td", {}, el("time", { datetime: entry.at }, when(entry.at))),
    el("td", {}, entry.who || "–", entry.role && el("small", { class: "muted" }, entry.role)),
    el("td", {}, entry.action),
    el("td", { class: entry.run || entry.about ? "about" : "about none" }, about(entry)),
    el("td", { class: "details" }, el("details", {}, el("summary", {}, line(entry)), el("dl", {}, ...facts(entry).flatMap(names)))),
  );
}

/** @param {Entry} entry */
const about = ({ run, about: what }) => (run ? el("a", { href: `/runs/${run.id}` }, `#${run.number} ${run.name}`) : what || "–");

function query() {
  const found = new URLSearchParams({ limit: String(LIMIT), offset: String(offset()) });
  for (const name of FIELDS) {
    const value = asked.get(name);
    if (value) found.set(name, name === "since" || name === "until" ? new Date(value).toISOString() : value);
  }
  return found;
}

async function show() {
  byId("refusal").textContent = "";
  try {
    const { entries, total, head } = await api.get(`/audit?${query()}`);
    if (!byId("chain").textContent) void (head.number > CHECKED_AT_ONCE ? unchecked(head.number) : check());
    byId("rows").replaceChildren(...entries.map(row));
    byId("table").hidden = !entries.length;
    byId("none").hidden = Boolean(entries.length);
    byId("none").textContent = FIELDS.some((name) => asked.get(name))
      ? "No entry matches the filter. Shorten a name, or widen the time."
      : "The log has no entry yet. Every change, sign-in and refusal appears here.";
    byId("pages").hidden = total <= LIMIT;
    byId("shown").textContent = `${offset() + 1} to ${offset() + entries.length} of ${total}`;
    byId("newer").disabled = offset() === 0;
    byId("older").disabled = offset() + entries.length >= total;
  } catch (error) {
    byId("refusal").textContent = explain(error);
  }
}

async function check() {
  const chain = byId("chain");
  byId("check").disabled = true;
  chain.textContent = "Checking the chain …";
  try {
    const { whole, sentence, checked_at } = await api.get("/audit/check");
    chain.classList.toggle("bad", !whole);
    chain.textContent = `${sentence} Checked ${when(checked_at)}.`;
  } catch (error) {
    chain.textContent = explain(error);
  }
  byId("check").disabled = false;
}

/** @param {number} entries */
const unchecked = (entries) => (byId("chain").textContent = `${entries} entries, not checked since this page was opened.`);

/** @param {Record<string, string>} changes */
function go(changes) {
  for (const [name, value] of Object.entries(changes)) {
    if (value) asked.set(name, value);
    else asked.delete(name);
  }
  history.pushState(null, "", `/audit${asked.size ? `?${asked}` : ""}`);
  void show();
}

function fill() {
  for (const name of FIELDS) form.elements.namedItem(name).value = asked.get(name) ?? "";
}

form.addEventListener("submit", (/** @type {Event} */ event) => {
  event.preventDefault();
  go({ offset: "", ...Object.fromEntries(FIELDS.map((name) => [name, form.elements.namedItem(name).value.trim()])) });
});
byId("newer").addEventListener("click", () => go({ offset: String(Math.max(0, offset() - LIMIT) || "") }));
byId("older").addEventListener("click", () => go({ offset: String(offset() + LIMIT) }));
byId("check").addEventListener("click", check);
addEventListener("popstate", () => location.reload());

fill();
void show();
