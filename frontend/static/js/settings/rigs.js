// @ts-check
// The rigs of the laboratory: list, add, edit, retire and delete.
import { api, explain } from "../api.js";
import { byId, el } from "../dom.js";
import { actuatorsOf, actuatorWords, addActuator } from "./actuators.js";

/** @typedef {{id: string, name: string, kind: string, tests_at_a_time: number | null, actuators: import("./actuators.js").Actuator[], retired: boolean, running: number, queued: number}} Rig */

const actuators = byId("rig-actuators");
const kind = byId("rig-kind");
/** @type {Rig | null} */
let edited = null;

/** @param {Rig} rig */
function row(rig) {
  const act = (/** @type {string} */ label, /** @type {() => void} */ click) =>
    el("button", { type: "button", class: "quiet small", "aria-label": `${label} ${rig.name}`, on: { click } }, label);
  const own = rig.id === "emulated";
  const { id: _, running: __, queued: ___, ...stored } = rig;
  return el(
    "tr",
    {},
    el("td", { class: "name" }, rig.name, el("small", { class: "muted" }, kindWords(rig))),
    el("td", { "data-label": "Actuators: stroke, velocity, force" }, ...(rig.actuators.length ? rig.actuators.map((one, index) => el("div", {}, actuatorWords(one, index))) : ["not limited"])),
    el("td", { "data-label": "Tests" }, `${rig.running} running, ${rig.queued} waiting`),
    el(
      "td",
      { "data-needs": "administrator" },
      el(
        "div",
        { class: "actions" },
        act("Edit", () => edit(rig)),
        !own && act(rig.retired ? "Take back" : "Retire", () => change(() => api.put(`/rigs/${rig.id}`, { ...stored, retired: !rig.retired }))),
        !own && act("Delete", () => change(() => api.remove(`/rigs/${rig.id}`))),
      ),
    ),
  );
}

/** @param {Rig} rig */
function kindWords({ kind, tests_at_a_time: most, retired }) {
  const many = most == null ? "any number of tests" : most === 1 ? "one test" : `${most} tests`;
  return `${kind}, ${many} at a time${retired ? ", retired" : ""}`;
}

/** @param {Rig | null} rig */
function edit(rig) {
  edited = rig;
  byId("rig-form-title").textContent = rig ? `Edit ${rig.name}` : "Add a rig";
  byId("rig-save").textContent = rig ? "Save the rig" : "Add the rig";
  byId("rig-stop").hidden = !rig;
  byId("rig-name").value = rig?.name ?? "";
  byId("rig-at-a-time").value = rig?.tests_at_a_time ?? "";
  kind.value = rig?.kind ?? "physical";
  actuators.replaceChildren();
  for (const one of rig?.actuators ?? [undefined]) addActuator(actuators, one);
  kinds();
  if (rig) byId("rig-name").focus();
}

const kinds = () => (byId("rig-at-a-time-label").hidden = kind.value === "physical");

/** @param {() => Promise<unknown>} send */
async function change(send) {
  byId("rig-refusal").textContent = "";
  try {
    await send();
    edit(null);
  } catch (error) {
    byId("rig-refusal").textContent = explain(error);
  }
  await show();
}

async function show() {
  const { rigs } = await api.get("/rigs");
  byId("rig-rows").replaceChildren(...rigs.map(row));
}

byId("rig-form").addEventListener("submit", (/** @type {Event} */ event) => {
  event.preventDefault();
  const many = byId("rig-at-a-time").value;
  const rig = {
    name: byId("rig-name").value.trim(),
    kind: kind.value,
    tests_at_a_time: kind.value === "physical" || many === "" ? null : Number(many),
    actuators: actuatorsOf(actuators),
    retired: edited?.retired ?? false,
  };
  const id = edited?.id;
  change(() => (id ? api.put(`/rigs/${id}`, rig) : api.post("/rigs", rig)));
});
byId("rig-more").addEventListener("click", () => addActuator(actuators));
byId("rig-stop").addEventListener("click", () => edit(null));
kind.addEventListener("change", kinds);
edit(null);
show().catch((error) => (byId("rig-refusal").textContent = explain(error)));
