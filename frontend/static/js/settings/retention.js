// @ts-check
// The retention of recordings: the rule, and what it would remove now. The preview stands below the button, which it must not move.
import { api, explain } from "../api.js";
import { byId, el, htmlElements } from "../dom.js";
import { size, when } from "../format.js";

const boxes = /** @type {HTMLInputElement[]} */ (htmlElements(document.getElementsByName("retention-state")));
/** @param {string} id */
const limit = (id) => (byId(id).value === "" ? null : Number(byId(id).value));

/** The rule as it stands in the form. */
function typed() {
  return {
    days: limit("retention-days"),
    gigabytes: limit("retention-gigabytes"),
    states: boxes.filter((box) => box.checked).map((box) => box.value),
    template: byId("retention-template").value.trim(),
    tag: byId("retention-tag").value.trim(),
  };
}

/** @param {any} rule */
function show(rule) {
  byId("retention-held").textContent = rule.due_at ? `${rule.sentence} Next removal: ${when(rule.due_at)} or later.` : rule.sentence;
  byId("retention-days").value = rule.days ?? "";
  byId("retention-gigabytes").value = rule.gigabytes ?? "";
  for (const box of boxes) box.checked = rule.states.includes(box.value);
  byId("retention-template").value = rule.template;
  byId("retention-tag").value = rule.tag;
}

let asked = 0;

/** Show what the typed rule would remove; an answer that a later change has overtaken is dropped. */
async function preview() {
  const mine = ++asked;
  const { days, gigabytes, states, template, tag } = typed();
  const host = byId("retention-preview");
  if (days === null && gigabytes === null) return host.replaceChildren(el("p", {}, "This rule removes nothing: all recordings are kept."));
  const query = new URLSearchParams([...Object.entries({ days, gigabytes, template, tag }).filter(([, value]) => value).map(([name, value]) => [name, String(value)]), ...states.map((state) => ["states", state])]);
  try {
    const found = await api.get(`/retention/preview?${query}`);
    if (mine !== asked) return;
    const runs = found.oldest.map((/** @type {any} */ one) => el("li", {}, el("a", { href: `/runs/${one.id}` }, `#${one.number} ${one.name}`), ` ended ${when(one.finished_at).slice(0, 10)}, ${size(one.size)}`));
    host.replaceChildren(el("p", {}, found.sentence), ...(runs.length ? [el("p", { class: "muted" }, "The oldest of them:"), el("ul", {}, ...runs)] : []));
  } catch (error) {
    if (mine === asked) host.replaceChildren(el("p", { class: "bad" }, explain(error)));
  }
}

byId("retention-form").addEventListener("input", () => void preview()); // not "change": it comes with the press on the button
byId("retention-form").addEventListener("submit", async (/** @type {Event} */ event) => {
  event.preventDefault();
  const note = byId("retention-note");
  try {
    show(await api.put("/retention", typed()));
    note.textContent = "Saved.";
  } catch (error) {
    note.textContent = explain(error);
  }
  await preview();
});

show(await api.get("/retention"));
await preview();
