// @ts-check
/** @typedef {import("./view.js").View} View */

/** Plays a test again from the shown moment: the view's head moves with the clock times the speed. */
export class Playback {
  /** @param {View} view @param {() => void} changed called when it starts or stops */
  constructor(view, changed) {
    this.view = view;
    this.changed = changed;
    this.speed = 1;
    this.playing = false;
    this.frame = 0;
  }

  /** Play from the shown moment, or from the start if that is the end. */
  play() {
    const { view } = this;
    const { head } = view;
    view.seek(head === null || head >= view.store.now ? 0 : head);
    this.playing = true;
    let before = performance.now();
    const step = (/** @type {number} */ now) => {
      this.#advance((this.speed * (now - before)) / 1000);
      before = now;
      if (this.playing) this.frame = requestAnimationFrame(step);
    };
    this.frame = requestAnimationFrame(step);
    this.changed();
  }

  /** Stop at the shown moment. */
  pause() {
    cancelAnimationFrame(this.frame);
    this.playing = false;
    this.view.head ??= this.view.store.now;
    this.view.seek(this.view.head);
    this.changed();
  }

  /** Show the newest sample. */
  live() {
    cancelAnimationFrame(this.frame);
    this.playing = false;
    this.view.seek(null);
    this.changed();
  }

  /** Move on by a time (s). At its end a test that has ended stops, and a running test is live again. @param {number} time */
  #advance(time) {
    const { view } = this;
    const next = (view.head ?? 0) + Math.max(0, time);
    if (next < view.store.now) return view.seek(next);
    this.live();
  }
}
