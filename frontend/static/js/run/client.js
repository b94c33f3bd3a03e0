// @ts-check
import { el, renew } from "../dom.js";
import { fixed, number } from "../format.js";
import { toast } from "../toast.js";

/**
 * The client of a test: where the rig waits for it with the lines for its script, how its steps go, and warnings about it.
 * @typedef {{state?: string, address: string, transport: string, lines?: {python: string, tcl: string}, note?: string | null, peer?: string,
 *   steps?: number, step_ms?: {median: number | null, p95: number | null, longest: number | null}, iterations?: number, warnings?: string[]}} Client
 */

const LANGUAGES = { python: "OpenSeesPy", tcl: "OpenSees, Tcl" };

/** Show the client of a test in its place on the page. @param {HTMLElement} host @param {Client | null | undefined} client */
export function showClient(host, client) {
  host.hidden = !client;
  if (!client) return;
  host.classList.toggle("waits", client.state === "waiting");
  renew(host, ...(client.state === "waiting" ? waiting(client) : connected(client)));
}

/** @param {Client} client @returns {HTMLElement[]} */
function waiting({ address, transport, lines, note }) {
  const rows = Object.entries(lines ?? {}).map(([language, text]) => line(LANGUAGES[/** @type {keyof typeof LANGUAGES} */ (language)], text));
  return [
    el("h2", {}, "Waiting for client"),
    el("p", {}, `The rig listens at ${address} by ${transport.toUpperCase()}. Put this element into the script of the structure, with your numbers for TAG and NODE, and run the script.`),
    ...(note ? [el("p", { class: "client-warning" }, note)] : []),
    el("dl", { class: "client-lines" }, ...rows.flat()),
    el("p", { class: "muted" }, el("a", { href: "/help/docs/opensees-rig.md" }, "How to drive the rig from OpenSees")),
  ];
}

/** @param {string} language @param {string} text @returns {HTMLElement[]} */
function line(language, text) {
  const copy = async () => {
    await navigator.clipboard.writeText(text);
    toast(`The line for ${language} is copied.`);
  };
  const button = el("button", { type: "button", class: "quiet", "aria-label": `Copy the line for ${language}`, on: { click: copy } }, "Copy line");
  return [el("dt", {}, language), el("dd", {}, el("code", { tabindex: "0" }, text), button)];
}

/** @param {Client} client @returns {HTMLElement[]} */
function connected(client) {
  const { warnings = [] } = client;
  return [el("p", { class: "client-steps" }, stepsOf(client)), ...warnings.map((text) => el("p", { class: "client-warning" }, text))];
}

/** The steps of a client in words. @param {Client} client */
export function stepsOf({ peer, transport, steps = 0, step_ms, iterations = 0 }) {
  const ms = (/** @type {number | null | undefined} */ value) => `${number(value ?? 0, 3)} ms`;
  const times = step_ms && step_ms.median !== null ? `, a step in ${ms(step_ms.median)} (median), 95 % within ${ms(step_ms.p95)}, longest ${ms(step_ms.longest)}` : "";
  const not = iterations ? `; ${fixed(iterations, 0)} displacements not followed` : "";
  return `Client ${peer} by ${transport.toUpperCase()}: ${fixed(steps, 0)} steps${times}${not}.`;
}
