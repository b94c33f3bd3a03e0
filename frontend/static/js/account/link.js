// @ts-check
// A one-time link: choose the password of an account, or name and password of the first administrator.
// The key of the link stands behind # in the address: it is in no log, and leaves the history of the browser here.
import { api, explain } from "../api.js";
import { byId } from "../dom.js";

const key = location.hash.slice(1);
history.replaceState(null, "", location.pathname);

async function open() {
  const { makes, name, replaces } = await api.post("/sign-in/link/read", { key });
  const first = makes === "first administrator";
  byId("title").textContent = first ? "Make the first administrator" : `Choose a password for ${name}`;
  byId("about").textContent = first
    ? "This control room has no account yet. The first one manages all others."
    : replaces
      ? "The new password signs you out in all other browsers. API tokens stay valid."
      : "You are signed in at once. Later you sign in with this name and password.";
  byId("named").hidden = !first;
  byId("name").value = name;
  byId("name").required = first;
  byId("choose").hidden = false;
  byId(first ? "name" : "password").focus();
}

byId("choose").addEventListener("submit", async (/** @type {SubmitEvent} */ event) => {
  event.preventDefault();
  const same = byId("password").value === byId("again").value;
  byId("refusal").textContent = same ? "" : "The two passwords differ. Type the same password twice.";
  if (!same) return;
  const button = /** @type {HTMLButtonElement} */ (event.submitter);
  button.disabled = true;
  try {
    await api.send("/sign-in/link", { key, password: byId("password").value, name: byId("name").value });
    location.assign("/");
  } catch (error) {
    byId("refusal").textContent = explain(error);
    button.disabled = false;
  }
});

open().catch((error) => {
  byId("about").textContent = "";
  byId("refusal").textContent = explain(error);
  byId("way-out").hidden = false;
});
