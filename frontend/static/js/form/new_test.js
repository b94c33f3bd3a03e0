// @ts-check
import { ApiError, api, explain } from "../api.js";
import { byId, el } from "../dom.js";
import { planProblems } from "./bounds.js";
import { liveCheck } from "./checker.js";
import { exportYaml, importYaml } from "./exchange.js";
import { asked, keeping, planOf } from "./keeping.js";
import { person, remember } from "../person.js";
import { PlanForm } from "./plan_form.js";
import { Schema } from "./schema.js";
import { problemList, summaryOf } from "./summary.js";

const DEFAULT_TEMPLATE = "table3-04";

const verdict = byId("verdict");
const who = byId("who");
const templates = byId("template");
/** @type {PlanForm} */
let form;
/** @type {{template: string | null, digest: string | null}} the template that filled the form, and its digest */
let origin = { template: null, digest: null };

const check = liveCheck(() => form.read(), told, (error) => (verdict.textContent = explain(error)));

/** @param {any | null} checked @param {any[]} refused */
function told(checked, refused) {
  const own = form.problems();
  const paths = new Set(own.map((problem) => problem.where));
  const problems = [...own, ...refused.filter((problem) => !paths.has(problem.where))];
  form.mark(problems);
  if (problems.length) {
    const count = problems.length === 1 ? "1 error" : `${problems.length} errors`;
    verdict.replaceChildren(el("p", { class: "error" }, count), problemList(problems, (where) => form.control(where)));
    return problems;
  }
  if (checked) {
    origin.digest ??= checked.digest;
    const changed = origin.template && origin.digest !== checked.digest;
    form.kept.template = changed ? null : origin.template;
    const paper = origin.template?.startsWith("table3-") ? " The result cannot be compared with the paper." : "";
    const note = changed && el("p", { class: "muted" }, `The plan differs from the template ${origin.template}.${paper}`);
    verdict.replaceChildren(el("p", { class: "good" }, "Ready to queue"), ...summaryOf(checked), note || "");
  }
  return problems;
}

const { draft, offer, source } = keeping({ read: () => form.read(), owner: () => who.value.trim(), show, restart: (from) => (from ? fillFrom(from) : clear()) });

/** Show a plan in the form. @param {any} plan */
function show(plan) {
  origin = { template: plan.template ?? null, digest: null };
  form.write(plan);
  check.now();
}

/** Fill the form anew; what was typed before stays a draft. @param {any} plan @param {import("./keeping.js").Origin | null} from */
function fill(plan, from) {
  draft.begin(from);
  templates.value = from?.kind === "template" ? from.id : "";
  show(plan);
}

/** @param {import("./keeping.js").Origin} from */
async function fillFrom(from) {
  const found = await planOf(from);
  fill(found.plan, found.origin);
}

const clear = () => fillFrom({ kind: "template", id: DEFAULT_TEMPLATE });

/** @param {Event} event */
async function submit(event) {
  event.preventDefault();
  if (!who.value.trim()) return refuseWho();
  remember(who.value.trim());
  const button = byId("submit");
  button.disabled = true;
  try {
    const own = form.problems();
    if (own.length) return focusFirst(told(null, own));
    const checked = await api.post("/plans/check", form.read());
    told(checked, []);
    const { runs } = await api.post("/runs", { plan: form.read(), submitted_by: who.value.trim(), library: source() });
    await draft.close("queued");
    location.assign(`/runs/${runs[0].id}`);
  } catch (error) {
    if (error instanceof ApiError && error.status < 500 && error.status > 0) focusFirst(told(null, planProblems(error)));
    else verdict.replaceChildren(el("p", { class: "error" }, explain(error)));
  } finally {
    button.disabled = false;
  }
}

function refuseWho() {
  byId("e-who").textContent = "is required: the name is stored with the run. This browser remembers the name.";
  who.setAttribute("aria-invalid", "true");
  who.focus();
}

/** @param {any[]} problems */
function focusFirst(problems) {
  const controls = problems.map(({ where }) => form.control(where)).filter((control) => control !== null);
  controls.sort((a, b) => (a.compareDocumentPosition(b) & Node.DOCUMENT_POSITION_FOLLOWING ? -1 : 1));
  (controls[0] ?? verdict).focus();
}

/** @param {{name: string, title: string, group: string}[]} offered */
function templateGroups(offered) {
  return [...new Set(offered.map((one) => one.group))].map((group) => {
    const own = offered.filter((one) => one.group === group);
    return el("optgroup", { label: group }, ...own.map((one) => el("option", { value: one.name }, one.title)));
  });
}

async function start() {
  const [schema, motions, offered] = await Promise.all([api.get("/schema"), api.get("/motions"), api.get("/templates")]);
  form = new PlanForm(byId("plan"), new Schema(schema), motions.motions);
  templates.append(...templateGroups(offered.templates));
  const wanted = asked();
  if (wanted.draft) return draft.open(wanted.draft);
  await (wanted.origin ? fillFrom(wanted.origin) : clear());
  await offer();
}

/** @param {unknown} error */
const complain = (error) => verdict.replaceChildren(el("p", { class: "error" }, explain(error)));

who.value = person();
who.addEventListener("input", () => {
  who.removeAttribute("aria-invalid");
  byId("e-who").textContent = "";
});
for (const event of ["input", "change"]) {
  byId("plan").addEventListener(event, () => {
    check.soon();
    draft.autosave();
  });
}
byId("new-test").addEventListener("submit", submit);
templates.addEventListener("change", () => templates.value && fillFrom({ kind: "template", id: templates.value }).catch(complain));
byId("export").addEventListener("click", () => exportYaml(form.read()).catch(complain));
byId("import").addEventListener("change", (/** @type {any} */ event) =>
  importYaml(event.target)
    .then((plan) => {
      fill(plan, null);
      draft.autosave();
    })
    .catch(complain),
);
start().catch(complain);
