// @ts-check
// The accounts: add them, change their roles, disable them, and make links by which their owners choose passwords.
import { api, explain } from "../api.js";
import { confirmed } from "../confirm.js";
import { byId, el, renew } from "../dom.js";
import { when } from "../format.js";

/** @typedef {{id: string, name: string, role: string, has_password: boolean, disabled_at: string | null}} Account */

const ROLES = [...byId("account-role").options].map((/** @type {any} */ option) => option.value);

/** @param {Account} account */
function row(account) {
  const path = `/accounts/${account.id}`;
  const act = (/** @type {string} */ label, /** @type {() => Promise<unknown>} */ send) =>
    el("button", { type: "button", class: "quiet small", "aria-label": `${label}: ${account.name}`, on: { click: () => change(send) } }, label);
  const role = el(
    "select",
    { "aria-label": `Role of ${account.name}`, on: { change: () => change(() => api.patch(path, { role: role.value })) } },
    ...ROLES.map((name) => el("option", { selected: name === account.role }, name)),
  );
  const state = account.disabled_at ? `disabled ${when(account.disabled_at)}` : account.has_password ? "can sign in" : "has no password yet";
  return el(
    "tr",
    {},
    el("td", {}, account.name),
    el("td", { "data-label": "Role" }, role),
    el("td", { "data-label": "State" }, state),
    el(
      "td",
      { class: "nowrap" },
      account.disabled_at ? false : act("Make a password link", async () => showLink(await api.post(`${path}/password-link`))),
      " ",
      account.disabled_at
        ? act("Enable the account", () => api.patch(path, { disabled: false }))
        : act("Disable the account", async () => (await disablingConfirmed(account)) && api.patch(path, { disabled: true })),
    ),
  );
}

/** @param {Account} account */
const disablingConfirmed = (account) =>
  confirmed({
    title: `Disable the account of ${account.name}?`,
    text: "Its sessions, API tokens and links end at once and for good, also if you enable the account again. Its tests and plans stay.",
    action: "Disable the account",
    keep: "Keep it enabled",
  });

/** @param {{account: Account, path: string, expires_at: string}} made */
function showLink({ account, path, expires_at }) {
  const words = `Give this link to ${account.name}. It works once, until ${when(expires_at)}, and is not shown again.`;
  byId("account-link").replaceChildren(el("p", {}, words), el("code", { class: "secret", tabindex: "0" }, location.origin + path));
  byId("account-link").hidden = false;
}

/** @param {() => Promise<unknown>} send */
async function change(send) {
  byId("accounts-refusal").textContent = "";
  try {
    await send();
  } catch (error) {
    byId("accounts-refusal").textContent = explain(error);
  }
  const { accounts } = await api.get("/accounts");
  renew(byId("account-rows"), ...accounts.map(row));
  byId("accounts-none").hidden = Boolean(accounts.length);
  byId("accounts-table").hidden = !accounts.length;
}

byId("account-form").addEventListener("submit", (/** @type {any} */ event) => {
  event.preventDefault();
  const form = event.target;
  change(async () => {
    showLink(await api.post("/accounts", { name: byId("account-name").value, role: byId("account-role").value }));
    form.reset();
  });
});
change(async () => undefined).catch((error) => (byId("accounts-refusal").textContent = explain(error)));
