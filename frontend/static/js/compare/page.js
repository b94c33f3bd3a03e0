// @ts-check
import { explain } from "../api.js";
import { byId } from "../dom.js";
import { Legend, swatch } from "./legend.js";
import { LoopCurves } from "./loop_curves.js";
import { fetchSignals } from "./signals.js";
import { TimeCurves } from "./time_curves.js";
import { View } from "./view.js";

const REFINED_AFTER_MS = 180; // after the last change of the zoom
const POINTS = 1000;

const found = JSON.parse(byId("comparison").textContent ?? "");
const view = new View(found.items.length, found.reference);
const roles = Object.fromEntries(found.roles.map((/** @type {any} */ role) => [role.role, role]));
/** @type {AbortController | null} */
let refining = null;
let later = 0;

/** What the address says about the signals. */
function chosen() {
  return { station: byId("station").value, floor: byId("floor").value, from_start: byId("from-start").checked };
}

/** @param {Record<string, any>} [part] */
function query(part = {}) {
  const wanted = new URLSearchParams({ items: found.items.map((/** @type {any} */ item) => item.ref).join(","), points: String(POINTS) });
  for (const [name, value] of Object.entries({ ...chosen(), ...part })) if (value !== "") wanted.set(name, String(value));
  return wanted;
}

/** @param {unknown} error */
const complain = (error) => (byId("refusal").textContent = `The signals are not shown: ${explain(error)}`);

/** The time that all items take together. @returns {[number, number]} */
function whole() {
  const ends = found.items.flatMap((/** @type {any} */ item) => {
    const start = item.kind === "run" || byId("from-start").checked ? 0 : item.start_s;
    return [start, start + item.duration_s];
  });
  return [Math.min(...ends), Math.max(...ends)];
}

async function load() {
  view.whole = whole();
  view.zoom = view.detail = null;
  byId("charts").setAttribute("aria-busy", "true");
  try {
    view.overview = await fetchSignals(query());
    byId("refusal").textContent = "";
  } catch (error) {
    complain(error);
  }
  byId("charts").setAttribute("aria-busy", "false");
  build();
  view.changed();
}

/** The first station in which the plans differ; the first station if they do not. */
function proposedStation() {
  const paths = [...document.querySelectorAll(".compared code")].map((code) => code.textContent?.match(/^stations\.(\d+)\./)?.[1]);
  const station = String(Number(paths.find(Boolean) ?? 0) + 1);
  return [...byId("station").options].some((/** @type {HTMLOptionElement} */ one) => one.value === station) ? station : "1";
}

const proposed = proposedStation();
let built = "";

/** Build the charts whose signals at least one item has. */
function build() {
  const wanted = Object.keys(roles).filter((role) => view.overview.has(role) && !(role === "d_alpha" && view.overview.still(role)));
  if (built === wanted.join(" ")) return;
  built = wanted.join(" ");
  view.clear();
  const has = (/** @type {string[]} */ ...names) => names.every((name) => wanted.includes(name));
  const charts = wanted.map((role) => new TimeCurves(view, role, roles[role].label, roles[role].unit));
  const loops = [
    has("x_meas", "f_meas") && new LoopCurves(view, "Force against displacement", roles.x_meas, roles.f_meas),
    has("x_cmd", "x_meas") && new LoopCurves(view, "Synchronisation subspace", roles.x_cmd, roles.x_meas),
  ].filter((one) => one instanceof LoopCurves);
  byId("charts").replaceChildren(...charts.slice(0, 2).map(({ element }) => element), ...loops.map(({ element }) => element), ...charts.slice(2).map(({ element }) => element));
}

/** Ask for the samples of the zoomed range, once the zoom rests. */
function refine() {
  byId("zoomed").textContent = view.zoom ? `Shown: ${view.zoom[0].toFixed(2)} s to ${view.zoom[1].toFixed(2)} s` : "";
  byId("reset").disabled = !view.zoom;
  clearTimeout(later);
  const range = view.zoom;
  if (!range || view.signals !== view.overview) return;
  later = setTimeout(async () => {
    refining?.abort();
    refining = new AbortController();
    try {
      const signals = await fetchSignals(query({ from_s: range[0], to_s: range[1] }), refining.signal);
      view.detail = { range, signals };
      view.changed();
    } catch (error) {
      if (!(error instanceof DOMException)) complain(error);
    }
  }, REFINED_AFTER_MS);
}

/** Keep what is shown in the address, so that the link shows the same. */
function keep() {
  const address = new URL(location.href);
  const { station, floor, from_start } = chosen();
  const kept = { station: station !== proposed && station, floor: floor !== String(found.top) && floor, from_start };
  for (const [name, value] of Object.entries(kept)) {
    if (value) address.searchParams.set(name, String(value));
    else address.searchParams.delete(name);
  }
  history.replaceState(null, "", address.href.replaceAll("%3A", ":").replaceAll("%2C", ","));
}

function restore() {
  const asked = new URLSearchParams(location.search);
  for (const name of ["station", "floor"]) {
    const box = byId(name);
    const value = asked.get(name) ?? (name === "floor" ? String(found.top) : proposed);
    if ([...box.options].some((/** @type {HTMLOptionElement} */ option) => option.value === value)) box.value = value;
  }
  byId("from-start").checked = asked.get("from_start") === "true";
}

async function copy() {
  const button = byId("copy");
  const address = location.href;
  try {
    await navigator.clipboard.writeText(address);
    button.textContent = "Link copied";
  } catch {
    button.textContent = "Copy the address of this page";
  }
}

for (const place of document.querySelectorAll("[data-item]")) place.prepend(swatch(Number(/** @type {HTMLElement} */ (place).dataset.item)));
restore();
new Legend(view, found.items);
let zoomed = view.zoom;
view.watchers.push(() => {
  if (zoomed !== view.zoom) refine();
  zoomed = view.zoom;
});
for (const name of ["station", "floor", "from-start"]) {
  byId(name).addEventListener("change", () => {
    keep();
    load();
  });
}
byId("reset").addEventListener("click", () => view.zoomTo(null));
byId("copy").addEventListener("click", copy);
document.addEventListener("themechange", () => view.changed());
load();
