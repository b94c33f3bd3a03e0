// @ts-check
// The form of the own password.
import { api, explain } from "../api.js";
import { byId } from "../dom.js";

byId("password-form").addEventListener("submit", async (/** @type {any} */ event) => {
  event.preventDefault();
  byId("password-said").textContent = byId("password-refusal").textContent = "";
  try {
    await api.send("/account/password", { present: byId("present").value, password: byId("password").value });
    event.target.reset();
    byId("password-said").textContent = "Changed. All other browsers are signed out.";
    document.dispatchEvent(new Event("sessions"));
  } catch (error) {
    byId("password-refusal").textContent = explain(error);
  }
});
