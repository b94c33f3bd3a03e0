// @ts-check
import { account } from "../person.js";
import { el } from "../dom.js";

/** @typedef {{from_s: number, to_s: number | null, station: number | null, text: string, by: string}} Given */

/** The dialog that asks for an annotation. */
export class NoteDialog {
  /** @param {{name: string}[]} stations */
  constructor(stations) {
    const number = { type: "number", min: 0, step: "any", inputmode: "decimal" };
    this.from = el("input", { id: "note-from", required: true, ...number });
    this.to = el("input", { id: "note-to", ...number });
    this.station = el("select", { id: "note-station" }, el("option", { value: "" }, "Whole test"), ...stations.map((one, i) => el("option", { value: i + 1 }, `${i + 1} · ${one.name}`)));
    this.text = el("textarea", { id: "note-text", rows: 3, maxlength: 2000, required: true });
    this.by = el("input", { id: "note-by", maxlength: 80, autocomplete: "name" });
    const field = (/** @type {string} */ label, /** @type {HTMLElement} */ input) => el("div", { class: "field" }, el("label", { for: input.id }, label), input);
    const cancel = el("button", { type: "button", class: "quiet", on: { click: () => this.element.close() } }, "Cancel");
    this.form = el(
      "form",
      { method: "dialog", class: "in-dialog", on: { submit: () => (this.given = this.#read()) } },
      el("h2", { id: "note-title" }, "Annotation"),
      el("div", { class: "note-fields" }, field("Time, s", this.from), field("To, s (for a span)", this.to), field("Concerns", this.station)),
      field("Note", this.text),
      account() === null && field("Your name", this.by),
      el("div", { class: "actions" }, el("button", { type: "submit" }, "Save the annotation"), cancel),
    );
    this.element = el("dialog", { class: "note-dialog", "aria-labelledby": "note-title" }, this.form);
    /** @type {Given | null} */
    this.given = null;
  }

  /** Ask for an annotation, filled with what is known. Null where the person cancels. @param {Given} known @returns {Promise<Given | null>} */
  ask(known) {
    this.given = null;
    this.from.value = String(known.from_s);
    this.to.value = known.to_s === null ? "" : String(known.to_s);
    this.station.value = known.station === null ? "" : String(known.station);
    this.text.value = known.text;
    this.by.value = known.by;
    this.element.showModal();
    this.text.focus();
    return new Promise((resolve) => this.element.addEventListener("close", () => resolve(this.given), { once: true }));
  }

  /** @returns {Given} */
  #read() {
    const to = this.to.value === "" ? null : Number(this.to.value);
    const station = this.station.value === "" ? null : Number(this.station.value);
    return { from_s: Number(this.from.value), to_s: to, station, text: this.text.value.trim(), by: this.by.value.trim() };
  }
}
