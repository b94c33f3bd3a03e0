// @ts-check
import { api, explain } from "../api.js";
import { el } from "../dom.js";
import { person, remember } from "../person.js";
import { may } from "../role.js";
import { NoteDialog } from "./note_dialog.js";

/**
 * @typedef {import("./view.js").View} View
 * @typedef {{id: string, number: number, from_s: number, to_s: number | null, station: number | null, text: string, by: string}} Note
 */

/**
 * The annotations of a run: marks on its charts, and a list below them. N writes one at the cursor.
 *
 *     const annotations = new Annotations(host, run, () => view);
 *     await annotations.load();
 */
export class Annotations {
  /** @param {HTMLElement} host @param {{id: string, plan: any}} run @param {() => View | undefined} view */
  constructor(host, run, view) {
    this.run = run;
    this.view = view;
    /** @type {Note[]} */
    this.notes = [];
    this.dialog = new NoteDialog(run.plan.stations);
    this.list = el("ol", { class: "notes" });
    this.empty = el("p", { class: "empty" }, "No annotation yet.", el("span", { "data-needs": "engineer" }, " Point at a chart and press N, or use the button: the note gets a number, a mark on every chart and a line in the report."));
    this.said = el("p", { class: "note-said", role: "status" });
    const write = el("button", { type: "button", class: "quiet", "data-needs": "engineer", on: { click: () => this.write() } }, "Write an annotation (N)");
    host.replaceChildren(el("h2", {}, "Annotations"), this.empty, this.list, el("div", { class: "actions" }, write), this.said, this.dialog.element);
    document.addEventListener("keydown", (event) => this.#key(event));
  }

  get address() {
    return `/runs/${this.run.id}/annotations`;
  }

  async load() {
    this.notes = (await api.get(this.address)).annotations;
    this.show();
  }

  /** Give the marks to the view and renew the list. */
  show() {
    const view = this.view();
    if (view) {
      view.notes = this.notes;
      view.redraw();
    }
    this.empty.hidden = this.notes.length > 0;
    this.list.replaceChildren(...this.notes.map((note) => this.#line(note)));
  }

  /** Write an annotation at the cursor, else at the shown moment. */
  async write() {
    const at = Math.max(0, this.view()?.pointed() ?? 0);
    const given = await this.dialog.ask({ from_s: Number(at.toFixed(3)), to_s: null, station: null, text: "", by: person() });
    if (given) await this.#change(() => api.post(this.address, given), given, "");
  }

  /** @param {Note} note */
  #line(note) {
    const time = note.to_s === null ? `${note.from_s.toFixed(2)} s` : `${note.from_s.toFixed(2)} to ${note.to_s.toFixed(2)} s`;
    const name = this.run.plan.stations[(note.station ?? 0) - 1]?.name;
    const where = note.station === null ? "" : ` · station ${note.station}${name ? `, ${name}` : ""}`;
    const go = el("button", { type: "button", class: "quiet small", "aria-label": `Show annotation ${note.number} at ${time}`, on: { click: () => this.view()?.seek(note.from_s) } }, time);
    const edit = el("button", { type: "button", class: "quiet small", "data-needs": "engineer", "aria-label": `Edit annotation ${note.number}`, on: { click: () => this.#edit(note) } }, "Edit");
    const remove = el("button", { type: "button", class: "quiet small", "data-needs": "engineer", "aria-label": `Delete annotation ${note.number}`, on: { click: () => this.#remove(note) } }, "Delete");
    const by = note.by ? el("span", { class: "muted" }, note.by) : null;
    return el("li", { value: note.number }, el("div", { class: "note-line" }, go, el("span", { class: "note-text" }, note.text, el("span", { class: "muted" }, where)), by, edit, remove));
  }

  /** @param {Note} note */
  async #edit(note) {
    const given = await this.dialog.ask(note);
    if (given) await this.#change(() => api.put(`${this.address}/${note.id}`, given), given, "");
  }

  /** @param {Note} note */
  async #remove(note) {
    const { from_s, to_s, station, text, by } = note;
    await this.#change(() => api.remove(`${this.address}/${note.id}`), null, `Annotation ${note.number} deleted. `);
    const undo = el("button", { type: "button", class: "quiet small", on: { click: () => this.#change(() => api.post(this.address, { from_s, to_s, station, text, by }), null, "") } }, "Undo");
    this.said.append(undo);
  }

  /** Send a change and show what is stored. A refusal opens the dialog again. @param {() => Promise<any>} send @param {any} given @param {string} said */
  async #change(send, given, said) {
    this.said.textContent = "";
    try {
      await send();
      if (given?.by) remember(given.by);
      await this.load();
      this.said.textContent = said;
    } catch (error) {
      this.said.textContent = `Not stored: ${explain(error)}`;
    }
  }

  /** @param {KeyboardEvent} event */
  #key(event) {
    if (event.key.toLowerCase() !== "n" || event.ctrlKey || event.metaKey || event.altKey || event.repeat || !may("engineer")) return;
    const { target } = event;
    if (target instanceof HTMLElement && target.closest("input, textarea, select, dialog[open], [contenteditable]")) return;
    event.preventDefault();
    void this.write();
  }
}
