// @ts-check
import { ApiError, api, explain } from "../api.js";
import { ask } from "../ask.js";
import { controlLine } from "../control/line.js";
import { UNKNOWN } from "../control/withheld.js";
import { byId, el } from "../dom.js";
import { person, remember } from "../person.js";
import { may } from "../role.js";
import { planProblems } from "./bounds.js";
import { liveCheck } from "./checker.js";
import { confirmed } from "./confirming.js";
import { keepForStability } from "./draft_stability.js";
import { exportYaml, importYaml } from "./exchange.js";
import { Foresight } from "./foresight.js";
import { asked, keeping, planOf } from "./keeping.js";
import { askBeforeLeaving } from "./leaving.js";
import { Outlook } from "./outlook.js";
import { Picker } from "./picker.js";
import { PlanForm } from "./plan_form.js";
import { Rail } from "./rail.js";
import { Schema } from "./schema.js";
import { Sketch } from "./sketch.js";
import { goTo, unfold } from "./station_fold.js";
import { Verdict } from "./verdict.js";

/** @typedef {import("./keeping.js").Origin} Origin */

const DEFAULT_TEMPLATE = "table3-04";
const KEPT = "What you typed is kept as a draft: you find it on the pages Plans and New test.";

const who = byId("who");
const rig = byId("rig");
const rail = new Rail(byId("rail"));
const verdict = new Verdict(byId("verdict"), byId("findings"), () => form);
/** @type {PlanForm} */
let form;
/** @type {Picker} */
let picker;
/** @type {Sketch} */
let sketch;
/** @type {Outlook} */
let outlook;
let edits = 0; // since the form was filled
let loads = 0;
let queueing = false;
let control = UNKNOWN;
let lookAtControl = () => {};

const foresight = new Foresight((outcome) => outlook.show(outcome));
const check = liveCheck(() => form.read(), told, (error) => verdict.complain(explain(error)));
const { draft, offer, source } = keeping({
  read: () => form.read(),
  owner: () => who.value.trim(),
  show,
  restart: (from) => (from ? load(from) : clear()),
  saved: () => (edits = 0),
});
const leave = askBeforeLeaving(() => edits > 0, () => draft.flush());

/** @param {any | null} checked @param {any[]} refused */
function told(checked, refused) {
  const problems = verdict.show(checked, refused);
  rail.refresh();
  if (problems.length) {
    foresight.drop();
    outlook.clear();
  } else if (checked) {
    sketch.draw(checked.plan);
    byId("stability-link").hidden = checked.plan.test !== "hybrid" || !checked.plan.stations.length;
    foresight.of(form.read(), rig.value);
  }
  return problems;
}

/** Show a plan in the form. @param {any} plan */
function show(plan) {
  edits = 0;
  verdict.begin(plan.template ?? null);
  form.write(plan);
  allowQueueing();
  rail.show(form.sections);
  check.now();
}

/** Fill the form anew; what was typed before stays a draft. @param {any} plan @param {Origin | null} from */
function fill(plan, from) {
  draft.begin(from);
  picker.value = from?.kind === "template" ? from.id : "";
  show(plan);
}

/** @param {Origin} from */
async function load(from) {
  const found = await planOf(from);
  fill(found.plan, found.origin);
}

const clear = () => load({ kind: "template", id: DEFAULT_TEMPLATE });

/**
 * Fill an edited form only after asking: before the plan is loaded, and again where the form was edited while it was loading.
 * @param {string} what @param {() => Promise<{plan: any, origin: Origin | null}>} loaded
 */
async function replace(what, loaded) {
  const agreed = () => ask({ title: `Replace the edited plan by ${what}?`, text: KEPT, yes: "Replace the plan", no: "Keep editing" });
  if (edits && !(await agreed())) return;
  const mine = ++loads;
  const before = edits;
  const found = await loaded();
  if (mine !== loads || (edits !== before && !(await agreed()))) return;
  fill(found.plan, found.origin);
  if (!found.origin) edited();
}

/** Why the reader may not queue a test of the rig without its control; empty where the reader may. */
function notDriving() {
  if (control.approvals || !control.refusals[rig.value]) return "";
  const { sentence } = /** @type {{sentence: string}} */ (control.rigs.find(({ rig_id }) => rig_id === rig.value));
  return `${sentence} Only the driver of a rig queues its tests: see the line below the buttons.`;
}

/** Whether the reader's role suffices to queue what the form holds. */
const mayQueue = () => may("engineer") || (edits === 0 && source() !== null);

/**
 * An operator queues plans of the library as they are: the button waits for one, and the sentence above the form says so. Where one person drives
 * a rig, only the driver queues, unless another person approves the test: the line below the button says who drives.
 */
function allowQueueing() {
  const withheld = mayQueue() ? notDriving() : byId("who-queues").textContent;
  const submit = byId("submit");
  submit.disabled = queueing || Boolean(withheld);
  submit.title = withheld || submit.dataset.keys;
}

/** Say who drives the rig of the test, and keep the control of the person while the page is open. */
function showControl() {
  const told = (/** @type {typeof control} */ said) => {
    control = said;
    allowQueueing();
  };
  lookAtControl = controlLine(byId("control"), ({ rig_id }) => rig_id === rig.value && !control.approvals && mayQueue(), { told });
}

function edited() {
  edits++;
  allowQueueing();
  check.soon();
  draft.autosave();
}

/** Queue the plan in the form: checked, simulated, and confirmed where it would trip. */
async function queue() {
  if (queueing || !may("operator") || byId("submit").disabled) return;
  if (!who.value.trim()) return refuseWho();
  remember(who.value.trim());
  queueing = byId("submit").disabled = true;
  try {
    const own = form.problems();
    if (own.length) return focusFirst(told(null, own));
    verdict.show(await api.post("/plans/check", form.read()), []);
    const plan = form.read();
    const outcome = await foresight.of(plan, rig.value);
    if (JSON.stringify(plan) !== JSON.stringify(form.read()) || !(outcome.found || outcome.failed)) return verdict.complain("Not queued: the plan was edited meanwhile. Queue the test again.");
    if (!(await confirmed(outcome))) return focusOn(outcome.found?.trip?.path ?? "");
    const { runs } = await api.post("/runs", { plan, submitted_by: who.value.trim(), library: source(), rig: rig.value });
    await draft.close("queued");
    leave();
    location.assign(`/runs/${runs[0].id}`);
  } catch (error) {
    if (error instanceof ApiError && error.status === 422) focusFirst(told(null, planProblems(error)));
    else verdict.complain(explain(error));
  } finally {
    queueing = false;
    allowQueueing();
  }
}

/** @param {string} path */
function focusOn(path) {
  const control = form.control(path);
  if (control) goTo(control);
}

function refuseWho() {
  byId("e-who").textContent = "is required: the name is stored with the run. This browser remembers the name.";
  who.setAttribute("aria-invalid", "true");
  who.focus();
}

/** @param {any[]} problems */
function focusFirst(problems) {
  const controls = problems.flatMap(({ where }) => form.control(where) ?? []);
  controls.forEach(unfold);
  controls.sort((a, b) => (a.compareDocumentPosition(b) & Node.DOCUMENT_POSITION_FOLLOWING ? -1 : 1));
  (controls[0] ?? byId("verdict")).focus();
}

/** Offer the rigs that take tests, where there is a choice. @param {{id: string, name: string, retired: boolean}[]} rigs */
function offerRigs(rigs) {
  const offered = rigs.filter((one) => !one.retired);
  rig.append(...offered.map(({ id, name }) => el("option", { value: id }, name)));
  byId("rig-field").hidden = offered.length < 2;
}

async function start() {
  const [schema, motions, offered, { rigs }] = await Promise.all([api.get("/schema"), api.get("/motions"), api.get("/templates"), api.get("/rigs")]);
  offerRigs(rigs);
  showControl();
  form = new PlanForm(byId("plan"), new Schema(schema), motions.motions);
  picker = new Picker(byId("template"), offered.templates, (name) => {
    const title = offered.templates.find((/** @type {any} */ one) => one.name === name).title;
    replace(`the template ${title}`, () => planOf({ kind: "template", id: name })).catch(complain);
  });
  sketch = new Sketch(byId("sketch"), schema.channels);
  outlook = new Outlook(byId("outlook"), byId("peaks"), byId("plan"), sketch);
  const wanted = asked();
  if (wanted.draft) return draft.open(wanted.draft);
  await (wanted.origin ? load(wanted.origin) : clear());
  await offer();
}

/** @param {unknown} error */
const complain = (error) => verdict.complain(explain(error));

who.value = person();
who.addEventListener("input", () => {
  who.removeAttribute("aria-invalid");
  byId("e-who").textContent = "";
});
who.addEventListener("change", () => {
  remember(who.value.trim());
  lookAtControl();
});
rig.addEventListener("change", () => {
  allowQueueing();
  lookAtControl();
  check.now();
});
for (const event of ["input", "change"]) byId("plan").addEventListener(event, edited);
byId("new-test").addEventListener("submit", (/** @type {Event} */ event) => event.preventDefault()); // Enter in a field queues nothing
byId("submit").addEventListener("click", queue);
document.addEventListener("keydown", (event) => {
  if (event.key !== "Enter" || !(event.ctrlKey || event.metaKey) || event.repeat || document.querySelector("dialog[open]")) return;
  event.preventDefault();
  queue();
});
byId("stability-link").addEventListener("click", () => keepForStability(form.read()));
byId("export").addEventListener("click", () => exportYaml(form.read()).catch(complain));
byId("import").addEventListener("change", (/** @type {any} */ event) =>
  importYaml(event.target)
    .then((plan) => replace("the imported plan", async () => ({ plan, origin: null })))
    .catch(complain),
);
allowQueueing();
start().catch(complain);
