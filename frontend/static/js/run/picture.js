// @ts-check
import { FloorGauges } from "./floor_gauges.js";
import { Gauges } from "./gauges.js";
import { Schematic } from "./schematic.js";

/** @typedef {import("./view.js").View} View */

/** The drawing of a test and its gauges, which follow one view. */
export class Picture {
  visible = true;

  /**
   * @param {View} view @param {any} plan @param {HTMLElement} seen the element that has to be in sight
   * @param {HTMLElement} drawing @param {HTMLElement} gauges @param {((station: number) => void) | null} [select]
   */
  constructor(view, plan, seen, drawing, gauges, select = null) {
    const { channels } = view.store;
    this.view = view;
    this.schematic = new Schematic(drawing, plan, channels);
    this.gauges = plan.stations.length ? new Gauges(gauges, plan, channels, select) : new FloorGauges(gauges, channels);
    view.add(seen, this);
  }

  resize() {
    this.schematic.fit();
  }

  draw() {
    this.#show(false);
  }

  follow() {
    this.#show(false);
  }

  readout() {
    this.#show(true);
  }

  /** @param {boolean} numbers */
  #show(numbers) {
    const { store, trip } = this.view;
    const time = this.view.shown();
    const moment = store.moment(time);
    if (this.gauges instanceof Gauges) this.gauges.trip = time >= store.now ? trip : null;
    this.schematic.show(moment, this.gauges.show(moment, numbers), numbers);
  }
}
