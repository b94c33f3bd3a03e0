// @ts-check
import { byId } from "../dom.js";
import { Playback } from "./playback.js";

/** @typedef {import("./view.js").View} View */

/** The controls of the replay: play and pause, the scrubber, speed, the shown window, and back to the newest sample. */
export class Transport {
  /** @param {View} view */
  constructor(view) {
    this.view = view;
    this.playback = new Playback(view, () => this.show());
    this.play = byId("play");
    this.scrubber = byId("scrubber");
    this.time = byId("shown-time");
    this.live = byId("live");
    this.listening = new AbortController();
    const { signal } = this.listening;
    this.play.addEventListener("click", () => this.toggle(), { signal });
    this.scrubber.addEventListener("input", () => this.#scrubbed(), { signal });
    this.live.addEventListener("click", () => this.playback.live(), { signal });
    byId("speed").addEventListener("change", () => (this.playback.speed = Number(byId("speed").value)), { signal });
    byId("window").addEventListener("change", () => this.#window(), { signal });
    byId("reset").addEventListener("click", () => view.zoomTo(null), { signal });
    byId("stage").addEventListener("keydown", (/** @type {KeyboardEvent} */ event) => this.#key(event), { signal });
    this.playback.speed = Number(byId("speed").value);
    view.moved = () => this.show();
    view.window = Number(byId("window").value) || null;
    byId("transport").hidden = false;
    byId("transport").classList.remove("awaiting");
    this.show();
  }

  /** While a test runs and its newest sample is shown, the button holds the picture; otherwise it plays. */
  toggle() {
    if (this.playback.playing || this.#following) this.playback.pause();
    else this.playback.play();
  }

  get #following() {
    return !this.view.ended && this.view.head === null;
  }

  /** Show the state of the replay and the newest time. */
  show() {
    const { view, playback } = this;
    const now = view.until();
    this.scrubber.max = String(view.ended ? view.store.now : view.store.end);
    this.scrubber.value = String(now);
    this.time.textContent = `${now.toFixed(2)} s`;
    this.scrubber.setAttribute("aria-valuetext", `${now.toFixed(2)} s`);
    this.play.textContent = playback.playing || this.#following ? "Pause" : "Play";
    this.play.setAttribute("aria-label", playback.playing || this.#following ? "Pause the replay" : "Play the test again");
    this.live.hidden = view.ended || view.head === null;
    byId("stage").classList.toggle("past", !view.ended && view.head !== null);
  }

  /** At the right end of a test that has ended, its end is shown as without a replay. */
  #scrubbed() {
    const { view } = this;
    const time = Number(this.scrubber.value);
    view.seek(view.ended && time >= view.store.now - view.store.step ? null : time);
  }

  #window() {
    this.view.window = Number(byId("window").value) || null;
    this.view.zoomTo(null);
  }

  /** @param {KeyboardEvent} event */
  #key(event) {
    if (event.key !== " " || !(event.target instanceof Element) || event.target.closest("button, input, select, a")) return;
    event.preventDefault();
    this.toggle();
  }

  close() {
    this.playback.playing = false;
    this.listening.abort();
  }
}
