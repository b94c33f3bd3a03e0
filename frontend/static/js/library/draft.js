// @ts-check
import { ApiError, api, explain } from "../api.js";
import { el } from "../dom.js";
import { may } from "../role.js";
import { heldHere, hold, release, remember } from "./held_here.js";
import { savedAt } from "./words.js";

/**
 * What a draft started from.
 * @typedef {{kind: "version" | "template" | "run", id: string, version?: number | null}} Origin
 */

/**
 * What the form gives: the plan in it, the name of its user, and how to show a plan and how to start again from an origin.
 * @typedef {{read: () => any, owner: () => string, show: (plan: any) => void, restart: (origin: Origin | null) => Promise<void>}} Form
 */

const QUIET_MS = 800;
const RETRY_MS = 5000;
const KEEPALIVE_BYTES = 60_000; // browsers refuse larger requests that outlive their page

/** A name that no other window has. `randomUUID` needs a secure context, which a laboratory's network often is not. */
const unique = () => [...crypto.getRandomValues(new Uint8Array(16))].map((byte) => byte.toString(16).padStart(2, "0")).join("");

/**
 * The draft of a form: saves what is typed, valid or not, shortly after each edit and when the page is left, and says so in
 * `host`. A draft that another window has saved since is never overwritten: the user decides.
 */
export class Draft {
  /** @param {HTMLElement} host @param {Form} form */
  constructor(host, form) {
    this.host = host;
    this.form = form;
    this.writer = unique();
    /** @type {Origin | null} */
    this.origin = null;
    this.id = unique();
    this.revision = 0; // 0: the service does not hold it
    this.edited = false;
    this.stopped = false;
    this.failed = false;
    this.timer = 0;
    /** @type {Promise<void>} */
    this.saving = Promise.resolve();
    addEventListener("pagehide", () => this.#leave());
    document.addEventListener("visibilitychange", () => document.visibilityState === "hidden" && this.#leave());
    addEventListener("beforeunload", (event) => this.failed && event.preventDefault());
  }

  /** Call before the form is filled anew: saves what is typed; the next edit starts a new draft. @param {Origin | null} origin */
  begin(origin) {
    clearTimeout(this.timer);
    this.saving = this.#save();
    this.#identify({ origin });
    this.host.replaceChildren();
    this.#address();
  }

  /** Continue a stored draft and show it. Edits that only this browser holds come first. @param {string} id */
  async open(id) {
    const copy = heldHere(id);
    const kept = await api.get(`/library/drafts/${encodeURIComponent(id)}`).catch((error) => {
      if (copy && error instanceof ApiError && error.status === 404) return { revision: 0, plan: null, writer: copy.writer, origin: copy.origin };
      throw error;
    });
    if (kept.closed_as) {
      this.#identify({ origin: kept.origin });
      this.form.show(kept.plan);
      return this.#say(el("span", {}, `This draft was ${kept.closed_as} ${savedAt(kept.closed_at)}. Your next edit starts a new draft.`));
    }
    this.#identify({ origin: kept.origin, id, revision: kept.revision });
    const unsaved = copy && JSON.stringify(copy.plan) !== JSON.stringify(kept.plan) ? copy : null;
    if (!unsaved) release(id);
    if (unsaved && (unsaved.revision === kept.revision || unsaved.writer === kept.writer)) {
      this.form.show(unsaved.plan);
      this.#say(el("span", {}, `Restored your edits of ${savedAt(unsaved.at)}, which only this browser held.`));
      return this.autosave();
    }
    this.form.show(kept.plan);
    this.#say(el("span", {}, `Draft saved ${savedAt(kept.saved_at)}`), unsaved && this.#button("Open the edits that only this browser holds", () => this.#keepCopy(unsaved)), this.#discarding());
  }

  /** Save shortly after the last edit. */
  autosave() {
    if (!may("engineer")) return;
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

  /** Discard the draft and start again from what it started from. The draft stays stored and can be restored. */
  async discard() {
    const { id, origin } = this;
    await this.close("discarded");
    await this.form.restart(origin);
    this.#say(el("span", {}, "Draft discarded."), this.#button("Restore the draft", () => this.#restore(id)));
  }

  /** The draft leaves the list of open drafts; the next edit starts a new draft. @param {"discarded" | "queued"} closed_as */
  async close(closed_as) {
    clearTimeout(this.timer);
    await this.saving;
    const { id, revision, origin } = this;
    if (revision) await api.post(`/library/drafts/${id}/close`, { closed_as });
    release(id);
    this.#identify({ origin });
  }

  /** @param {string} id */
  async #restore(id) {
    await api.post(`/library/drafts/${id}/reopen`);
    await this.open(id);
    this.#address();
  }

  /** @param {{origin: Origin | null, id?: string, revision?: number}} draft */
  #identify({ origin, id = unique(), revision = 0 }) {
    Object.assign(this, { origin, id, revision, edited: false, stopped: false, failed: false });
  }

  async #save() {
    if (!this.edited || this.stopped) return;
    this.edited = false;
    const { id, revision, writer, origin } = this;
    const body = { plan: this.form.read(), revision, writer, origin, owner: this.form.owner() };
    try {
      const kept = await api.put(`/library/drafts/${id}`, body, JSON.stringify(body).length < KEEPALIVE_BYTES);
      release(id);
      remember(id);
      if (this.id !== id) return;
      Object.assign(this, { revision: kept.revision, failed: false });
      this.#say(el("span", {}, `Draft saved ${savedAt(kept.saved_at)}`), this.#discarding());
      this.#address();
    } catch (error) {
      hold(id, { ...body, at: new Date().toISOString() });
      if (this.id === id) this.#refused(error);
    }
  }

  /** @param {unknown} error */
  #refused(error) {
    Object.assign(this, { edited: true, failed: true });
    if (error instanceof ApiError && error.status === 409) {
      this.stopped = true;
      const words = el("span", { class: "error", role: "alert" }, `Not saved: ${error.message}`);
      return this.#say(words, this.#button("Save mine as a new draft", () => this.#saveAsNew()), this.#button("Load the other draft", () => this.#loadOther()));
    }
    this.#say(el("span", { class: "error", role: "alert" }, `Not saved: ${explain(error)} This browser holds your edits.`));
    if (error instanceof ApiError && (error.status === 0 || error.status >= 500)) this.timer = setTimeout(() => this.flush(), RETRY_MS);
  }

  async #saveAsNew() {
    release(this.id);
    this.#identify({ origin: this.origin });
    this.edited = true;
    await this.flush();
  }

  async #loadOther() {
    release(this.id);
    await this.open(this.id);
  }

  /** @param {import("./held_here.js").Copy} copy */
  async #keepCopy(copy) {
    release(this.id);
    this.#identify({ origin: copy.origin });
    this.form.show(copy.plan);
    this.edited = true;
    await this.flush();
  }

  /** The page is left, or may be: save at once in a request that outlives the page, and hold a copy until it is confirmed. */
  #leave() {
    if (!this.edited || this.stopped) return;
    const { id, revision, writer, origin } = this;
    hold(id, { plan: this.form.read(), revision, writer, origin, at: new Date().toISOString() });
    this.#save();
  }

  /** The address of the page names the draft, so that a reload continues it. */
  #address() {
    const named = new URLSearchParams(location.search).get("draft");
    if (this.revision && named !== this.id) history.replaceState(null, "", `/new?draft=${this.id}`);
    if (!this.revision && named) history.replaceState(null, "", "/new");
  }

  #discarding() {
    return this.#button("Discard the draft", () => this.discard());
  }

  /** @param {string} label @param {() => Promise<void>} act */
  #button(label, act) {
    const click = () => act().catch((error) => this.#say(el("span", { class: "error", role: "alert" }, explain(error))));
    return el("button", { type: "button", class: "quiet small", on: { click } }, label);
  }

  /** @param {...(HTMLElement | null)} said */
  #say(...said) {
    this.host.replaceChildren(...said.filter((one) => one !== null));
  }
}
