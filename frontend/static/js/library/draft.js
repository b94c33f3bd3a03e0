// @ts-check
import { ApiError, api, explain } from "../api.js";
import { el } from "../dom.js";
import { when } from "../format.js";
import { heldHere, hold, release } from "./held_here.js";

/**
 * What a draft started from.
 * @typedef {{kind: "version" | "template" | "run", id: string, version?: number | null}} Origin
 * @typedef {{id: string, revision: number, saved_at: string, origin: Origin | null}} Kept
 */

const QUIET_MS = 800;
const RETRY_MS = 5000;
const KEEPALIVE_BYTES = 60_000; // browsers refuse larger requests that outlive their page

/** A name that no other window has. `randomUUID` needs a secure context, which a laboratory's network often is not. */
const unique = () => [...crypto.getRandomValues(new Uint8Array(16))].map((byte) => byte.toString(16).padStart(2, "0")).join("");

/** Local time of a save, with the date where it is not today's. @param {string} iso */
export function savedAt(iso) {
  const text = when(iso);
  return text.slice(0, 10) === when(new Date().toISOString()).slice(0, 10) ? text.slice(11) : text;
}

/**
 * The draft of a form: saves what is typed, valid or not, shortly after each edit and when the page is left, and says so in
 * `host`. A draft that another window has saved since is never overwritten: the user decides.
 *
 * `begin(origin)` before the form is filled anew: the next edit starts a new draft. `open(id)` for a stored draft. `autosave()`
 * after each edit. `settled` is false while an edit is not stored.
 */
export class Draft {
  /**
   * @param {HTMLElement} host
   * @param {() => any} read gives the plan in the form
   * @param {() => string} owner gives the name of the user
   */
  constructor(host, read, owner) {
    this.host = host;
    this.read = read;
    this.owner = owner;
    this.writer = unique();
    /** @type {Origin | null} */
    this.origin = null;
    this.id = unique();
    this.revision = 0;
    this.edited = false;
    this.stopped = false;
    this.timer = 0;
    /** @type {Promise<void>} */
    this.saving = Promise.resolve();
    addEventListener("pagehide", () => this.#leave());
    document.addEventListener("visibilitychange", () => document.visibilityState === "hidden" && this.#leave());
  }

  /** Whether the service holds every edit. */
  get settled() {
    return !this.edited;
  }

  /** Whether the service holds this draft. */
  get stored() {
    return this.revision > 0;
  }

  /** The form is about to be filled anew: save what is typed; the next edit starts a new draft. @param {Origin | null} origin */
  begin(origin) {
    clearTimeout(this.timer);
    this.saving = this.#save();
    Object.assign(this, { origin, id: unique(), revision: 0, edited: false, stopped: false });
    this.host.replaceChildren();
    this.#address();
  }

  /** Continue a stored draft. Edits that only this browser holds come first. @param {string} id @returns {Promise<any>} the plan as typed */
  async open(id) {
    const copy = heldHere(id);
    const kept = await api.get(`/library/drafts/${encodeURIComponent(id)}`).catch((error) => {
      if (copy && error instanceof ApiError && error.status === 404) return { id, revision: 0, plan: null, writer: copy.writer, origin: copy.origin };
      throw error;
    });
    Object.assign(this, { origin: kept.origin, id, revision: kept.revision, edited: false, stopped: false });
    const newer = copy && JSON.stringify(copy.plan) !== JSON.stringify(kept.plan);
    if (copy && !newer) release(id);
    if (newer && (copy.revision === kept.revision || copy.writer === kept.writer)) {
      this.#say(el("span", {}, `Restored from this browser: the edits of ${savedAt(copy.at)} had not been saved.`));
      this.edited = true;
      return copy.plan;
    }
    this.#say(el("span", {}, `Draft saved ${savedAt(kept.saved_at)}`), newer && this.#button("Keep the edits that only this browser holds", () => this.#keepCopy(copy)));
    if (kept.closed_as) await this.#reopen();
    return kept.plan;
  }

  /** Save shortly after the last edit. */
  autosave() {
    this.edited = true;
    if (this.stopped) return;
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.flush(), QUIET_MS);
  }

  /** Save now what is not saved; returns when the service has answered. */
  flush() {
    clearTimeout(this.timer);
    this.saving = this.saving.then(() => this.#save());
    return this.saving;
  }

  /** Discard the draft. It stays stored: `restore` brings it back. */
  async discard() {
    await this.close("discarded");
  }

  /** The plan went on: the draft leaves the list of open drafts. @param {"discarded" | "queued"} closed_as */
  async close(closed_as) {
    clearTimeout(this.timer);
    await this.saving;
    this.edited = false;
    release(this.id);
    if (this.stored) await api.post(`/library/drafts/${this.id}/close`, { closed_as });
  }

  /** Bring a discarded draft back. */
  async restore() {
    await this.#reopen();
    this.#say(el("span", {}, "Draft restored"));
  }

  async #reopen() {
    this.revision = (await api.post(`/library/drafts/${this.id}/reopen`)).revision;
  }

  async #save() {
    if (!this.edited || this.stopped) return;
    this.edited = false;
    const { id, revision, writer, origin } = this;
    const plan = this.read();
    try {
      const body = { plan, revision, writer, origin, owner: this.owner() };
      const kept = await api.put(`/library/drafts/${id}`, body, JSON.stringify(body).length < KEEPALIVE_BYTES);
      release(id);
      if (this.id !== id) return;
      this.revision = kept.revision;
      this.#say(el("span", {}, `Draft saved ${savedAt(kept.saved_at)}`));
      this.#address();
    } catch (error) {
      hold(id, { plan, revision, writer, origin, at: new Date().toISOString() });
      if (this.id === id) this.#failed(error);
    }
  }

  /** @param {unknown} error */
  #failed(error) {
    this.edited = true;
    if (error instanceof ApiError && error.status === 409) return this.#conflict(error);
    this.#say(el("span", { class: "error", role: "alert" }, `Not saved: ${explain(error)} This browser holds the edits.`));
    const again = error instanceof ApiError && (error.status === 0 || error.status >= 500);
    if (again) this.timer = setTimeout(() => this.flush(), RETRY_MS);
  }

  /** @param {ApiError} error */
  #conflict(error) {
    this.stopped = true;
    this.#say(
      el("span", { class: "error", role: "alert" }, `Not saved: ${error.message}`),
      this.#button("Save mine as a new draft", () => this.#saveAsNew()),
      this.#button("Load the other draft", () => this.#loadOther()),
    );
  }

  async #saveAsNew() {
    release(this.id);
    Object.assign(this, { id: unique(), revision: 0, edited: true, stopped: false });
    await this.flush();
  }

  #loadOther() {
    release(this.id);
    this.edited = false;
    location.assign(`/new?draft=${this.id}`);
  }

  /** @param {import("./held_here.js").Copy} copy */
  async #keepCopy(copy) {
    const id = unique();
    await api.put(`/library/drafts/${id}`, { plan: copy.plan, revision: 0, writer: "", origin: copy.origin, owner: this.owner() });
    release(this.id);
    location.assign(`/new?draft=${id}`);
  }

  /** The page is left, or may be: send what is not saved in a request that outlives the page, and hold a copy until it is confirmed. */
  #leave() {
    if (!this.edited || this.stopped) return;
    const { id, revision, writer, origin } = this;
    hold(id, { plan: this.read(), revision, writer, origin, at: new Date().toISOString() });
    this.#save(); // at once: a page that is left does not wait for the save before
  }

  /** The address of the page names the draft, so that a reload continues it. */
  #address() {
    const asked = new URLSearchParams(location.search);
    if (this.stored && asked.get("draft") !== this.id) history.replaceState(null, "", `/new?draft=${this.id}`);
    if (!this.stored && asked.has("draft")) history.replaceState(null, "", "/new");
  }

  /** @param {string} label @param {() => Promise<void> | void} click */
  #button(label, click) {
    return el("button", { type: "button", class: "quiet small", on: { click } }, label);
  }

  /** @param {...(HTMLElement | false | null)} said */
  #say(...said) {
    this.host.replaceChildren(...said.filter((one) => one instanceof HTMLElement));
  }
}
