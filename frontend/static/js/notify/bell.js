// @ts-check
// The list of the latest events in the header of every page: it counts the unread ones, and shows a message at each end of a test.
import { api } from "../api.js";
import { byId, el } from "../dom.js";
import { toast } from "../toast.js";
import { desktopControl, tellDesktop } from "./desktop.js";

/** @typedef {{number: number, at: string, kind: string, about: string, about_id: string | null, run_id: string | null, name: string, sentence: string}} Told */

const PERIOD_MS = 3000;
const SHOWN = 20;
const MOST_TOASTS = 3; // more at once become one message
const SEEN = "rths.events.seen";
const KINDS = ["completed", "tripped", "failed", "cancelled", "requeued", "held", "released", "to approve", "approved"];
const ENDS = new Set(["completed", "tripped", "failed"]);
const QUERY = KINDS.map((kind) => `kind=${encodeURIComponent(kind)}`).join("&");
const bell = byId("bell");
const panel = byId("bell-panel");
const badge = el("span", { class: "unread", hidden: true });
bell.append(badge);

/** @type {number | null} the newest event that this page knows */
let latest = null;
/** @type {Told[]} newest first */
let events = [];

/** @param {string} kind */
export const tone = (kind) => (kind === "tripped" || kind === "failed" ? "bad" : kind === "completed" ? "good" : "");

/** @param {Told} event */
function address({ about, about_id: id }) {
  if (about === "queue") return "/queue";
  const pages = { run: "runs", sweep: "sweeps", diagnosis: "diagnoses" };
  return about in pages ? `/${/** @type {any} */ (pages)[about]}/${id}` : null;
}

/** @param {Told} event */
function item(event) {
  const to = address(event);
  const words = to ? el("a", { href: to }, event.sentence) : event.sentence;
  return el("li", { class: tone(event.kind) }, words, el("time", { datetime: event.at }, new Date(event.at).toLocaleString("en-GB")));
}

function showPanel() {
  const list = events.length
    ? el("ol", {}, ...events.slice(0, SHOWN).map(item))
    : el("p", { class: "empty" }, "No event yet. Ends and trips of tests, and holds of the queue, appear here.");
  panel.replaceChildren(el("strong", {}, "Latest events"), list, desktopControl(), el("p", {}, el("a", { href: "/settings#webhooks" }, "Webhooks")));
}

function count() {
  const seen = Number(localStorage.getItem(SEEN) ?? 0);
  const unread = events.filter((event) => event.number > seen).length;
  badge.hidden = !unread;
  badge.textContent = unread >= SHOWN ? `${SHOWN}+` : String(unread);
  bell.setAttribute("aria-label", unread ? `Events, ${badge.textContent} unread` : "Events");
}

function read() {
  if (latest != null) localStorage.setItem(SEEN, String(latest));
  count();
}

/** @param {Told[]} fresh newest first */
function tell(fresh) {
  const ends = fresh.filter((event) => ENDS.has(event.kind));
  for (const event of ends) tellDesktop(event);
  if (ends.length > MOST_TOASTS) {
    const bad = ends.filter((event) => tone(event.kind) === "bad").length;
    const text = `${ends.length} tests ended${bad ? `, ${bad} of them tripped or failed` : ""}.`;
    toast(text, { tone: bad ? "bad" : "good", more: [el("a", { href: "/runs" }, "Show the runs")] });
    return;
  }
  for (const event of [...ends].reverse()) {
    const to = address(event);
    const here = to === location.pathname;
    if (!here) toast(event.sentence, { tone: tone(event.kind), more: to ? [el("a", { href: to }, "Show it")] : [] });
  }
}

async function look() {
  try {
    const after = latest == null ? "" : `&after=${latest}`;
    const told = await api.get(`/events?${QUERY}&limit=${SHOWN}${after}`);
    if (latest == null && localStorage.getItem(SEEN) == null) localStorage.setItem(SEEN, String(told.latest));
    if (latest != null) tell(told.events);
    events = [...told.events, ...events].slice(0, SHOWN);
    latest = told.latest;
    count();
    if (told.events.length && !panel.hidden) {
      showPanel();
      read();
    }
  } catch {
    // the service does not answer; the page's own parts say so
  }
  setTimeout(look, PERIOD_MS);
}

/** @param {boolean} open */
function toggle(open) {
  panel.hidden = !open;
  bell.setAttribute("aria-expanded", String(open));
  if (!open) return;
  showPanel();
  read();
}

bell.addEventListener("click", () => toggle(panel.hidden));
document.addEventListener("keydown", (event) => {
  if (event.key !== "Escape" || panel.hidden) return;
  toggle(false);
  bell.focus();
});
document.addEventListener("click", (event) => {
  if (!panel.hidden && event.target instanceof Node && event.target.isConnected && !byId("bell-box").contains(event.target)) toggle(false);
});
look();
