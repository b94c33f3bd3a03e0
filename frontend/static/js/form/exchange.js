// @ts-check
import { api } from "../api.js";
import { el } from "../dom.js";
import { withinLimit } from "../limit.js";

/** Download the plan as a YAML file. @param {any} plan */
export async function exportYaml(plan) {
  const text = await api.postForText("/plans/write", plan);
  const url = URL.createObjectURL(new Blob([text], { type: "application/yaml" }));
  const name = plan.name.replace(/[^\p{L}\p{N}]+/gu, "-").replace(/^-|-$/g, "").toLowerCase() || "plan";
  el("a", { href: url, download: `${name}.yaml` }).click();
  URL.revokeObjectURL(url);
}

/** Read a plan from the selected YAML file. @param {HTMLInputElement} input */
export async function importYaml(input) {
  const text = await withinLimit(/** @type {FileList} */ (input.files)[0]).text();
  input.value = "";
  return api.postText("/plans/read", text, "application/yaml");
}
