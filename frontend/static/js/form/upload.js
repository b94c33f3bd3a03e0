// @ts-check
import { ApiError, api } from "../api.js";
import { el } from "../dom.js";
import { contentsOf } from "../files/contents.js";
import { rateSays } from "../files/rate.js";
import { refusalOf } from "../files/refusal.js";
import { number } from "../format.js";
import { withinLimit } from "../limit.js";
import { labelled } from "./field.js";
import { previewOf } from "./preview.js";

/** @typedef {{number: number, name: string, unit: string, dt_s: number | null, samples: number, largest: number, applied: string, asks: string[]}} Channel */

const UNITS = ["g", "g/10", "mg", "m/s^2", "cm/s^2", "mm/s^2", "in/s^2", "ft/s^2"];
const QUIET_MS = 400;

/** The upload of a record: what stands in the file, then a preview, then the entry in the library. */
class Upload {
  /** @param {(motion: any) => void} added */
  constructor(added) {
    this.added = added;
    this.looks = 0;
    this.typing = 0;
    /** @type {Channel[]} */
    this.channels = [];
    this.file = el("input", { type: "file" });
    this.channel = el("select");
    this.unit = el("select", {}, el("option", { value: "" }, "choose the unit"), ...UNITS.map((name) => el("option", { value: name }, name)));
    this.count = el("input", { type: "text", placeholder: "2.34e-6 m/s^2", autocomplete: "off" });
    this.dt = el("input", { type: "text", inputmode: "decimal", autocomplete: "off" });
    this.name = el("input", { type: "text", placeholder: "from the file's name", autocomplete: "off" });
    this.fields = {
      channel: labelled("upload.channel", "Channel", this.channel, "the file has several channels of acceleration", "", true),
      unit: labelled("upload.unit", "Unit of the acceleration", this.unit, "the file does not state it"),
      count: labelled("upload.count", "Acceleration of one count", this.count, "the file gives counts without a scale factor"),
      dt: labelled("upload.dt", "Time step", this.dt, "the file does not state it", "s"),
      name: labelled("upload.name", "Name in the library", this.name),
    };
    this.told = el("div", { class: "note bad", role: "alert" });
    this.asked = el("p", { class: "note", role: "status" });
    this.contents = el("div");
    this.shown = el("div");
    this.add = el("button", { type: "button", on: { click: () => this.#keep() } }, "Add to the library");
    this.element = this.#build();
    this.#offer([]);
  }

  #build() {
    const { channel, unit, count, dt, name } = this.fields;
    this.file.addEventListener("change", () => this.#open());
    for (const control of [this.channel, this.unit]) control.addEventListener("change", () => this.#look());
    const soon = () => {
      clearTimeout(this.typing);
      this.typing = setTimeout(() => this.#look(), QUIET_MS);
    };
    for (const control of [this.count, this.dt]) control.addEventListener("input", soon);
    const box = el(
      "details",
      { class: "upload", "data-needs": "engineer" },
      el("summary", {}, "Upload a record: a strong-motion file or columns of numbers"),
      el("div", { class: "fields" }, labelled("upload.file", "File", this.file)),
      this.told,
      this.contents,
      el("div", { class: "fields" }, channel, unit, count, dt, name),
      this.asked,
      this.shown,
      this.add,
    );
    for (const event of ["input", "change"]) box.addEventListener(event, (/** @type {Event} */ e) => e.stopPropagation());
    return box;
  }

  /** Ask the service what stands in the chosen file. */
  async #open() {
    const mine = ++this.looks;
    this.#offer([]);
    for (const part of [this.told, this.contents, this.shown]) part.replaceChildren();
    this.unit.value = this.count.value = this.dt.value = "";
    if (!this.file.files.length) return;
    try {
      const found = await api.postForm("/motions/contents", this.#form());
      if (mine !== this.looks) return;
      this.contents.replaceChildren(contentsOf(found, found.columns));
      this.#offer(found.channels);
      await this.#look();
    } catch (error) {
      if (mine === this.looks) this.#refused(error);
    }
  }

  /** @param {Channel[]} channels */
  #offer(channels) {
    this.channels = channels;
    const text = (/** @type {Channel} */ { name, unit, samples, largest }) => `${name}: ${samples} samples, at most ${number(largest)} ${unit}`.trim();
    const options = channels.map((one) => el("option", { value: one.number }, text(one)));
    const one = channels.length === 1;
    this.channel.replaceChildren(...(one ? [] : [el("option", { value: "" }, "choose the channel")]), ...options);
    this.#ask();
  }

  /** The chosen channel, or undefined. @returns {Channel | undefined} */
  get #chosen() {
    return this.channels.find((one) => String(one.number) === this.channel.value);
  }

  /** Show the fields that the file leaves open, and say which of them are still empty. Returns whether all are given. */
  #ask() {
    const chosen = this.#chosen;
    const asks = chosen?.asks ?? [];
    this.fields.channel.hidden = this.channels.length < 2;
    this.fields.unit.hidden = !asks.includes("unit");
    this.fields.count.hidden = !asks.includes("count");
    this.fields.dt.hidden = !asks.includes("dt");
    this.fields.name.hidden = !this.channels.length;
    const step = Number(this.dt.value);
    const hint = /** @type {HTMLElement} */ (this.fields.dt.querySelector(".hint"));
    hint.textContent = chosen && step > 0 ? rateSays(1 / step, chosen.samples) : "the file does not state it";
    const lacks = [
      this.channels.length > 1 && !chosen && "the channel",
      asks.includes("unit") && !this.unit.value && "the unit",
      asks.includes("count") && !this.count.value.trim() && "the acceleration of one count",
      asks.includes("dt") && !this.dt.value.trim() && "the time step",
    ].filter(Boolean);
    this.asked.textContent = lacks.length ? `Give ${lacks.join(" and ")}.` : "";
    const ready = this.channels.length > 0 && !lacks.length;
    this.add.disabled = !ready;
    return ready;
  }

  #form() {
    const data = new FormData();
    data.set("file", withinLimit(this.file.files[0]));
    const several = this.channels.length > 1 ? this.channel.value : "";
    const asks = this.#chosen?.asks ?? [];
    const unit = asks.includes("unit") ? this.unit.value : asks.includes("count") ? this.count.value : "";
    const given = { unit, dt: asks.includes("dt") ? this.dt.value : "", name: this.name.value, channel: several };
    for (const [key, value] of Object.entries(given)) if (value.trim()) data.set(key, value.trim());
    return data;
  }

  async #look() {
    const mine = ++this.looks;
    this.told.replaceChildren();
    if (!this.#ask()) return this.shown.replaceChildren();
    try {
      const preview = await api.postForm("/motions/preview", this.#form());
      if (mine === this.looks) this.shown.replaceChildren(previewOf(preview));
    } catch (error) {
      if (mine === this.looks) this.#refused(error);
    }
  }

  async #keep() {
    this.add.disabled = true;
    this.looks++;
    try {
      const motion = await api.postForm("/motions", this.#form());
      this.file.value = "";
      this.#offer([]);
      this.contents.replaceChildren();
      this.told.replaceChildren();
      this.shown.replaceChildren(el("p", { role: "status" }, `${motion.name} was added to the library and selected.`));
      this.added(motion);
    } catch (error) {
      this.add.disabled = false;
      this.#refused(error);
    }
  }

  /** @param {unknown} error */
  #refused(error) {
    this.shown.replaceChildren();
    this.told.replaceChildren(refusalOf(error));
    const asked = error instanceof ApiError && error.errors.map(({ where }) => where).find((where) => /(unit|dt)$/.test(where ?? ""));
    const control = asked && (asked.endsWith("dt") ? this.dt : this.fields.count.hidden ? this.unit : this.count);
    if (control && ![this.dt, this.count].includes(document.activeElement)) control.focus();
  }
}

/** The upload of a record. @param {(motion: any) => void} added is called with a record that was added to the library @returns {HTMLElement} */
export const uploadBox = (added) => new Upload(added).element;
