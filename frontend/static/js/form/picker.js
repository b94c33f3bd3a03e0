// @ts-check
import { el } from "../dom.js";

/** @typedef {{name: string, title: string, group: string, about: string}} Template */

/** The first sentence of a text. @param {string} text */
const sentence = (text) => /^.*?[.!?](?=\s|$)/.exec(text)?.[0] ?? text;

const STEPS = { ArrowDown: 1, ArrowRight: 1, ArrowUp: -1, ArrowLeft: -1 };

/**
 * The choice of a template: a button with the title of the template in the form, and a dialog with all templates in groups,
 * each with a sentence. Arrow keys move between the templates.
 */
export class Picker {
  /** @param {HTMLButtonElement} button @param {Template[]} templates @param {(name: string) => void} chosen */
  constructor(button, templates, chosen) {
    this.button = button;
    this.templates = templates;
    this.chosen = chosen;
    this.name = "";
    this.cards = new Map(templates.map((one) => [one.name, this.#card(one)]));
    this.dialog = el("dialog", { class: "picker", "aria-labelledby": "picker-title" }, this.#contents());
    this.dialog.addEventListener("keydown", (/** @type {KeyboardEvent} */ event) => this.#key(event));
    this.dialog.addEventListener("click", (/** @type {Event} */ event) => event.target === this.dialog && this.dialog.close());
    button.after(this.dialog);
    button.addEventListener("click", () => this.#open());
    this.value = "";
  }

  /** The name of the template that is in the form; empty for none. */
  get value() {
    return this.name;
  }

  set value(name) {
    this.name = name;
    const found = this.templates.find((one) => one.name === name);
    const words = this.button.querySelector(".picker-now");
    if (words) words.textContent = found?.title ?? "Choose a template";
    for (const [key, card] of this.cards) {
      card.tabIndex = key === (found?.name ?? this.templates[0]?.name) ? 0 : -1;
      if (key === name) card.setAttribute("aria-current", "true");
      else card.removeAttribute("aria-current");
    }
  }

  #open() {
    this.dialog.showModal();
    [...this.cards.values()].find((card) => card.tabIndex === 0)?.focus();
  }

  #contents() {
    const groups = [...new Set(this.templates.map((one) => one.group))];
    const close = el("button", { type: "button", class: "quiet", on: { click: () => this.dialog.close() } }, "Close the list");
    const head = el("div", { class: "picker-head" }, el("h2", { id: "picker-title" }, "Start from a template"), close);
    const sections = groups.map((group) => this.#group(group));
    const families = sections.filter((section) => section.className === "family");
    const others = sections.filter((section) => section.className !== "family");
    return el("div", { class: "picker-box" }, head, ...families, el("div", { class: "picker-groups" }, ...others));
  }

  /** @param {string} group */
  #group(group) {
    const own = this.templates.filter((one) => one.group === group);
    const family = own.length > 1 && own.every(({ about }) => about === own[0].about);
    const cards = own.map(({ name, about }) => {
      const card = /** @type {HTMLButtonElement} */ (this.cards.get(name));
      if (!family && about) card.append(el("span", { class: "picker-about" }, sentence(about)));
      return card;
    });
    return el("section", { class: family ? "family" : "" }, el("h3", {}, group), family && own[0].about ? el("p", { class: "muted" }, own[0].about) : null, el("div", { class: "picker-cards" }, ...cards));
  }

  /** @param {Template} template @returns {HTMLButtonElement} */
  #card({ name, title }) {
    const choose = () => {
      this.dialog.close();
      this.chosen(name);
    };
    return el("button", { type: "button", class: "picker-card", "data-template": name, tabindex: -1, on: { click: choose } }, el("span", { class: "picker-title" }, title));
  }

  /** @param {KeyboardEvent} event */
  #key(event) {
    const cards = [...this.cards.values()];
    const at = cards.indexOf(/** @type {any} */ (document.activeElement));
    const step = STEPS[/** @type {keyof typeof STEPS} */ (event.key)];
    if (at < 0 || !step) return;
    event.preventDefault();
    cards[(at + step + cards.length) % cards.length].focus();
  }
}
