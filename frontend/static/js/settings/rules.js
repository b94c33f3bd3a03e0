// @ts-check
// The rules of the laboratory: switches that are off at first.
import { api, explain } from "../api.js";
import { byId } from "../dom.js";

/** Each rule and its switch. @type {Record<string, string>} */
const SWITCHES = { one_driver: "rule-one-driver", approvals: "rule-approvals" };

/** @param {Record<string, any>} rules */
function show(rules) {
  for (const [rule, id] of Object.entries(SWITCHES)) byId(id).checked = rules[rule];
  byId("rule-approvers").value = rules.approvers.join(", ");
}

byId("rules-form").addEventListener("submit", async (/** @type {Event} */ event) => {
  event.preventDefault();
  const note = byId("rules-note");
  try {
    const switched = Object.fromEntries(Object.entries(SWITCHES).map(([rule, id]) => [rule, byId(id).checked]));
    const approvers = byId("rule-approvers").value.split(",").map((/** @type {string} */ name) => name.trim()).filter(Boolean);
    show(await api.put("/rules", { ...switched, approvers }));
    note.textContent = "Saved. The rules hold from now on.";
  } catch (error) {
    note.textContent = explain(error);
  }
});

show(await api.get("/rules"));
