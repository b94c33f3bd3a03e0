// @ts-check
import { api, explain } from "../api.js";
import { byId, el } from "../dom.js";
import { keptForStability } from "../form/draft_stability.js";
import { fixed, number } from "../format.js";
import { loading } from "../ready.js";
import { drawMap, mapWords } from "./map.js";

const page = byId("stability");
const tabs = [byId("tab-contour"), byId("tab-surface")];
/** @type {any} */
let found = null;
let kind = "contour";

/** The plan of a template or a run, or the draft that the form keeps in this browser. */
async function planToPredict() {
  if (page.dataset.source) return (await api.get(page.dataset.source)).plan;
  const draft = keptForStability();
  if (!draft) throw new Error("This browser keeps no draft. Open the page New test and follow its link to the stability map.");
  return draft;
}

async function load() {
  try {
    found = await api.post("/stability", await planToPredict());
  } catch (error) {
    byId("verdict").classList.add("bad");
    byId("verdict").textContent = explain(error);
    return;
  }
  byId("tables").hidden = found.radius == null;
  byId("margins-part").hidden = !found.stations.length;
  if (found.radius == null) {
    byId("verdict").textContent = `${found.name}: ${found.notes.join(" ")}`;
    return;
  }
  showVerdict();
  byId("notes").replaceChildren(...found.notes.map((/** @type {string} */ note) => el("li", {}, note)));
  byId("margins").replaceChildren(...margins());
  byId("modes").replaceChildren(...modes());
  byId("map-part").hidden = !found.map;
  if (found.map) showMap();
}

function showVerdict() {
  const verdict = byId("verdict");
  verdict.classList.add(found.stable ? "held" : "bad");
  const mode = found.least_damped;
  const least = mode ? ` Least damped mode: ${number(mode.frequency_hz)} Hz, damping ratio ${fixed(100 * mode.damping_ratio, 2)} %.` : "";
  verdict.textContent =
    `${found.name}: predicted ${found.stable ? "stable" : "unstable"} for small motions about rest. Spectral radius ${fixed(found.radius, 5)} per step.${least}`;
}

/** @param {string[]} heads @param {number} words number of columns with words instead of numbers */
const head = (heads, words = 0) =>
  el("thead", {}, el("tr", {}, ...heads.map((text, i) => el("th", { scope: "col", class: i < words ? null : "number" }, text))));

function margins() {
  const rows = found.stations.map((/** @type {any} */ station) => {
    const steps = station.delay_margin_steps;
    const words = steps == null ? ["more than 1000", "–"] : [fixed(steps, 1), fixed(1000 * station.delay_margin_s, 1)];
    return el("tr", {}, el("td", { class: "name" }, station.name), ...words.map((text) => el("td", { class: "number" }, text)));
  });
  return [head(["Station", "Margin, controller steps", "Margin, ms"], 1), el("tbody", {}, ...rows)];
}

function modes() {
  const rows = found.modes.map((/** @type {any} */ mode) =>
    el("tr", {}, ...[number(mode.frequency_hz), fixed(100 * mode.damping_ratio, 2), fixed(mode.radius, 5)].map((text) =>
      el("td", { class: "number" }, text))));
  return [head(["Frequency, Hz", "Damping ratio, %", "Spectral radius"]), el("tbody", {}, ...rows)];
}

function showMap() {
  byId("map-words").textContent = mapWords(found.map, found);
  drawMap(byId("map"), found.map, found.radius, kind);
}

/** @param {number} chosen */
function choose(chosen) {
  kind = chosen ? "surface" : "contour";
  tabs.forEach((tab, i) => {
    tab.setAttribute("aria-selected", String(i === chosen));
    tab.tabIndex = i === chosen ? 0 : -1;
  });
  byId("map").setAttribute("aria-labelledby", tabs[chosen].id);
  showMap();
}

tabs.forEach((tab, i) => {
  tab.addEventListener("click", () => choose(i));
  tab.addEventListener("keydown", (/** @type {KeyboardEvent} */ event) => {
    if (event.key !== "ArrowLeft" && event.key !== "ArrowRight") return;
    choose(1 - i);
    tabs[1 - i].focus();
  });
});
byId("template").addEventListener("change", (/** @type {any} */ event) => (location.href = `/stability/${event.target.value}`));
document.addEventListener("themechange", () => found?.map && showMap());
void loading(load());
