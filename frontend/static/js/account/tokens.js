// @ts-check
// The API tokens of the own account. A new token is shown once.
import { api, explain } from "../api.js";
import { byId, el, renew } from "../dom.js";
import { when } from "../format.js";

/** @typedef {{id: string, name: string, scopes: string[], expires_at: string, used_at: string | null}} Token */

/** @param {Token} token */
function row(token) {
  const revoke = el("button", { type: "button", class: "quiet small", "aria-label": `Revoke the token ${token.name}` }, "Revoke");
  revoke.addEventListener("click", () => change(() => api.remove(`/account/tokens/${token.id}`)));
  return el(
    "tr",
    {},
    el("td", {}, token.name),
    el("td", { "data-label": "Scopes" }, token.scopes.join(", ")),
    el("td", { "data-label": "Expires" }, when(token.expires_at)),
    el("td", { "data-label": "Last used" }, token.used_at ? when(token.used_at) : "never"),
    el("td", {}, revoke),
  );
}

/** @param {() => Promise<unknown>} send */
async function change(send) {
  byId("token-refusal").textContent = "";
  try {
    await send();
    const { tokens } = await api.get("/account/tokens");
    renew(byId("token-rows"), ...tokens.map(row));
    byId("tokens-none").hidden = Boolean(tokens.length);
    byId("tokens-table").hidden = !tokens.length;
  } catch (error) {
    byId("token-refusal").textContent = explain(error);
  }
}

byId("token-form").addEventListener("submit", (/** @type {any} */ event) => {
  event.preventDefault();
  const form = event.target;
  const scopes = [...form.querySelectorAll('[name="scope"]:checked')].map((/** @type {any} */ box) => box.value);
  change(async () => {
    const made = await api.post("/account/tokens", { name: byId("token-name").value, scopes, days: Number(byId("token-days").value) });
    const key = el("code", { class: "secret", tabindex: "0" }, made.token);
    byId("token-made").replaceChildren(el("p", {}, `Token ${made.name}. Keep it now: it is not shown again.`), key);
    byId("token-made").hidden = false;
    form.reset();
  });
});
change(async () => undefined);
