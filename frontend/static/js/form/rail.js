// @ts-check
import { el } from "../dom.js";

/** @typedef {{id: string, title: string, element: HTMLElement}} Section */

const SETTLES_MS = 800; // the page scrolls to a chosen section
const READ = "-15% 0px -75% 0px"; // the band of the window in which a section counts as read

/** The rail of sections: a link to each, the section that is read marked, and the number of errors of each. */
export class Rail {
  /** @param {HTMLElement} host */
  constructor(host) {
    this.host = host;
    /** @type {Map<HTMLElement, {item: HTMLElement, link: HTMLElement, errors: HTMLElement}>} */
    this.entries = new Map();
    /** @type {Set<Element>} */
    this.read = new Set();
    this.quietUntil = 0;
    this.spy = new IntersectionObserver((seen) => this.#seen(seen), { rootMargin: READ });
  }

  /** @param {Section[]} sections */
  show(sections) {
    this.spy.disconnect();
    this.read.clear();
    this.entries = new Map(sections.map((section) => [section.element, this.#entry(section)]));
    this.host.replaceChildren(el("ol", {}, ...[...this.entries.values()].map(({ item }) => item)));
    for (const { element } of sections) this.spy.observe(element);
    this.refresh();
  }

  /** Hide the links of hidden sections and count the errors anew. */
  refresh() {
    for (const [section, { item, errors }] of this.entries) {
      const count = section.querySelectorAll("[aria-invalid]").length;
      item.hidden = section.hidden;
      errors.textContent = count ? String(count) : "";
      errors.hidden = !count;
      errors.setAttribute("aria-label", count === 1 ? "1 error" : `${count} errors`);
    }
  }

  /** @param {Section} section */
  #entry({ id, title, element }) {
    const errors = el("span", { class: "rail-errors", role: "img", hidden: true });
    const go = (/** @type {Event} */ event) => {
      event.preventDefault();
      this.quietUntil = performance.now() + SETTLES_MS; // a section near the end of the page can't reach its top
      this.#mark(element);
      element.scrollIntoView();
      /** @type {HTMLElement} */ (document.getElementById(id)).focus({ preventScroll: true });
    };
    const link = el("a", { href: `#${id}`, on: { click: go } }, title, " ", errors);
    return { item: el("li", {}, link), link, errors };
  }

  /** @param {IntersectionObserverEntry[]} seen */
  #seen(seen) {
    for (const { target, isIntersecting } of seen) this.read[isIntersecting ? "add" : "delete"](target);
    const first = [...this.entries.keys()].find((section) => this.read.has(section) && !section.hidden);
    if (first && performance.now() > this.quietUntil) this.#mark(first);
  }

  /** @param {HTMLElement} present */
  #mark(present) {
    for (const [section, { link }] of this.entries) {
      if (section === present) link.setAttribute("aria-current", "true");
      else link.removeAttribute("aria-current");
    }
  }
}
