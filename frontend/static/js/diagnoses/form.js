// @ts-check
import { api, explain } from "../api.js";
import { byId } from "../dom.js";
import { person } from "../person.js";

const form = byId("diagnose");
const plan = /** @type {HTMLSelectElement} */ (byId("plan"));
const file = /** @type {HTMLInputElement} */ (byId("plan-file"));

/** Convert `run:ID` to the object that the service expects. @param {string} chosen @returns {Record<string, string>} */
function source(chosen) {
  const at = chosen.indexOf(":");
  return { [chosen.slice(0, at)]: chosen.slice(at + 1) };
}

/** The part of the request that names the plan. @returns {Promise<Record<string, string | boolean>>} */
async function planned() {
  if (plan.value === "own") return {};
  if (plan.value === "linear") return { linear: true };
  if (plan.value !== "file") {
    const { template, run, extended } = source(plan.value);
    return template ? { template } : run ? { plan_of_run: run } : { extended_plan_of: extended };
  }
  const chosen = file.files?.[0];
  if (!chosen) throw new Error("Select a plan file, or select another plan.");
  return { plan: await chosen.text() };
}

async function asked() {
  const recording = byId("recording").value;
  if (!recording) throw new Error("Select a recording.");
  return {
    recording: source(recording),
    heldout: [...byId("heldout").selectedOptions].map((option) => source(option.value)),
    level: Number(byId("level").value) || byId("level").value,
    name: byId("title").value,
    submitted_by: person(),
    ...(await planned()),
  };
}

const shown = () => (byId("plan-file-field").hidden = plan.value !== "file");
plan.addEventListener("change", shown);
byId("recording").addEventListener("change", () => {
  const imported = byId("recording").value.startsWith("recording:"); // an imported recording has no plan of its own
  if (imported && plan.value === "own") plan.value = "linear";
  shown();
});
shown();

form.addEventListener("submit", async (/** @type {SubmitEvent} */ event) => {
  event.preventDefault();
  const button = byId("submit");
  button.disabled = true;
  try {
    const { id } = await api.post("/diagnoses", await asked());
    location.assign(`/diagnoses/${id}`);
  } catch (error) {
    byId("refusal").textContent = explain(error);
    button.disabled = false;
  }
});
