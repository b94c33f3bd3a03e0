// @ts-check
// The sign-in page: a session, and back to the page that was asked for.
import { api, explain } from "../api.js";
import { byId } from "../dom.js";

/** A path of this control room; anything else leads to the Lab page. @param {string | null} to */
function ownPath(to) {
  const own = to && URL.canParse(to, location.origin) ? new URL(to, location.origin) : null;
  return own && own.origin === location.origin && !own.pathname.startsWith("/sign-in") ? `${own.pathname}${own.search}${own.hash}` : "/";
}

byId("sign-in").addEventListener("submit", async (/** @type {SubmitEvent} */ event) => {
  event.preventDefault();
  const button = /** @type {HTMLButtonElement} */ (event.submitter);
  byId("refusal").textContent = "";
  button.disabled = true;
  try {
    await api.send("/sign-in", { name: byId("name").value, password: byId("password").value });
    location.assign(ownPath(new URLSearchParams(location.search).get("to")));
  } catch (error) {
    byId("refusal").textContent = explain(error);
    button.disabled = false;
    byId("password").select();
  }
});
