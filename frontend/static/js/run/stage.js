// @ts-check
import { el } from "../dom.js";
import { LoopChart } from "./loop_chart.js";
import { Picture } from "./picture.js";
import { floorStrips, inputStrips, pair, stationStrips } from "./signals.js";
import { TimePanel } from "./time_panel.js";

/** @typedef {import("./view.js").View} View */

/** The strips of each kind of test on the first screen. @type {Record<string, string[]>} */
export const FIRST = {
  hybrid: ["displacement", "error", "ti", "d_alpha"],
  specimen: ["displacement", "force", "error", "current"],
  actuator: ["displacement", "error", "ti", "d_alpha"],
  structure: [],
  client: ["displacement", "force", "error", "d_alpha"],
};

/** The first screen: what is tested and how it moves, gauges of all stations, the loop of one station and its signals on one time axis. */
export class Stage {
  /** @param {HTMLElement} host @param {View} view @param {any} plan @param {Record<string, any>} declared channels of the service */
  constructor(host, view, plan, declared) {
    this.view = view;
    this.plan = plan;
    this.declared = declared;
    const cell = (/** @type {string} */ name) => el("div", { class: `stage-${name}` });
    const [schematic, gauges, loop, time] = ["schematic", "gauges", "loop", "time"].map(cell);
    this.loopCell = loop;
    const tested = plan.stations.length > 0;
    this.element = el("div", { class: `stage of-${plan.test}` }, schematic, gauges, ...(tested ? [loop] : []), time);
    host.replaceChildren(this.element);
    this.panel = new TimePanel(time, view);
    /** @type {LoopChart | null} */
    this.loop = null;
    new Picture(view, plan, this.element, schematic, gauges, (station) => this.select(station));
    this.select(0);
  }

  /** Show the loop and the signals of a station. @param {number} station from 0 */
  select(station) {
    const { view, plan } = this;
    if (!plan.stations.length) return this.panel.show([...floorStrips(view.store), ...inputStrips(view.store, plan)]);
    if (this.loop) view.remove(this.loop.figure.element);
    const [x, y] = pair(view.store, plan, station, ["x_meas", "displacement"], ["f_meas", "force"]);
    const which = plan.stations.length > 1 ? `, station ${station + 1}` : "";
    this.loop = new LoopChart(view, `Force against displacement${which}`, x, y);
    this.loopCell.replaceChildren(this.loop.figure.element);
    this.panel.show(stationStrips(view.store, plan, station, FIRST[plan.test], this.declared));
    view.redraw();
  }
}
