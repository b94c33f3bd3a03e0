// @ts-check
// The browsers in which the own account is signed in.
import { api, explain } from "../api.js";
import { byId, el, renew } from "../dom.js";
import { when } from "../format.js";

/** @typedef {{id: string, seen_at: string, address: string, browser: string, present: boolean}} Session */

/** The names of browser and system in a User-Agent header. @param {string} agent */
function called(agent) {
  const browser = ["Edg", "OPR", "Firefox", "Chrome", "Safari"].find((name) => agent.includes(name));
  const system = ["Windows", "Android", "iPhone", "iPad", "Mac OS", "Linux"].find((name) => agent.includes(name));
  const name = { Edg: "Edge", OPR: "Opera" }[browser ?? ""] ?? browser ?? (agent.slice(0, 40) || "unknown");
  return system ? `${name} on ${system}` : name;
}

/** @param {Session} session */
function row(session) {
  const end = el("button", { type: "button", class: "quiet small", "aria-label": `Sign out ${called(session.browser)} at ${session.address}` }, "Sign out");
  end.addEventListener("click", () => change(() => api.remove(`/account/sessions/${session.id}`)));
  return el(
    "tr",
    {},
    el("td", {}, called(session.browser)),
    el("td", { "data-label": "Address" }, session.address),
    el("td", { "data-label": "Last used" }, when(session.seen_at)),
    el("td", {}, session.present ? "this browser" : end),
  );
}

/** @param {() => Promise<unknown>} send */
async function change(send) {
  byId("sessions-refusal").textContent = "";
  try {
    await send();
    await show();
  } catch (error) {
    byId("sessions-refusal").textContent = explain(error);
  }
}

async function show() {
  const { sessions } = await api.get("/account/sessions");
  renew(byId("session-rows"), ...sessions.map(row));
  byId("sessions-end").disabled = sessions.length < 2;
}

byId("sessions-end").addEventListener("click", () => change(() => api.remove("/account/sessions")));
document.addEventListener("sessions", () => change(async () => undefined));
change(async () => undefined);
