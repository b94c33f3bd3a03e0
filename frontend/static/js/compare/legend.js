// @ts-check
import { byId, el } from "../dom.js";
import { reading } from "../format.js";
import { look } from "./looks.js";
import { valueAt } from "./signals.js";

/** @typedef {import("./view.js").View} View */

/** A short line in the look of an item. @param {number} item */
export function swatch(item) {
  const { colour, dash } = look(item);
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  const line = document.createElementNS("http://www.w3.org/2000/svg", "line");
  svg.setAttribute("viewBox", "0 0 30 6");
  svg.setAttribute("class", "swatch-line");
  svg.setAttribute("aria-hidden", "true");
  for (const [name, value] of Object.entries({ x1: 1, y1: 3, x2: 29, y2: 3, class: colour.slice(2), "stroke-dasharray": dash.join(" ") })) {
    line.setAttribute(name, String(value));
  }
  svg.append(line);
  return svg;
}

/** The list of items that shows, hides and highlights their curves, with their values at the cursor. */
export class Legend {
  /** @param {View} view @param {any[]} items */
  constructor(view, items) {
    this.view = view;
    this.rows = items.map((item, k) => {
      const box = el("input", { type: "checkbox", checked: true, on: { change: () => view.show(k, box.checked) } });
      const value = el("output", { class: "value", "aria-live": "off" });
      const name = el("span", { class: "name", title: item.name }, item.label, el("span", { class: "of" }, item.name));
      const row = el("label", { class: k === view.reference ? "entry reference" : "entry" }, box, swatch(k), name, value);
      row.addEventListener("pointerenter", () => view.highlight(k, true));
      row.addEventListener("pointerleave", () => view.highlight(null));
      box.addEventListener("focus", () => box.matches(":focus-visible") && view.highlight(k, true));
      box.addEventListener("blur", () => view.highlight(null));
      return { row, box, value };
    });
    byId("legend").replaceChildren(...this.rows.map(({ row }) => el("li", {}, row)));
    byId("show-all").addEventListener("click", () => this.#all(true));
    byId("hide-others").addEventListener("click", () => this.#all(false));
    view.watchers.push(() => this.update());
  }

  /** Show all items, or the reference alone. @param {boolean} shown */
  #all(shown) {
    this.rows.forEach(({ box }, k) => {
      box.checked = shown || k === this.view.reference;
      this.view.show(k, box.checked);
    });
  }

  update() {
    const { asked, time, highlighted, hidden, signals } = this.view;
    byId("legend-of").textContent = asked && time !== null ? `${asked.title} at ${time.toFixed(3)} s` : "Move over a chart to read its values";
    this.rows.forEach(({ row, value }, k) => {
      row.classList.toggle("highlighted", k === highlighted);
      row.classList.toggle("hidden", hidden.has(k));
      value.textContent = asked && time !== null ? reading(valueAt(signals.get(k, asked.role), time)) : "";
    });
  }
}
