// @ts-check
import { el } from "../dom.js";
import { fixed } from "../format.js";
import { ended, reason } from "../run/facts.js";
import { follow } from "../run/live.js";
import { LoopChart } from "../run/loop_chart.js";
import { Picture } from "../run/picture.js";
import { floorStrips, inputStrips, pair, stationStrips } from "../run/signals.js";
import { Store } from "../run/store.js";
import { TimePanel } from "../run/time_panel.js";
import { View } from "../run/view.js";

const MOST_LOOPS = 4;
const FEW = 2; // stations whose tracking indicators have room beneath the displacements

/** One test on the wall: its name and time, what is tested, the gauges, the loops and the displacements of all stations. */
export class Display {
  /** @param {any} run with its plan @param {Record<string, any>} declared channels of the service @param {boolean} alone whether no other test is shown */
  constructor(run, declared, alone) {
    this.run = run;
    this.alone = alone;
    this.declared = declared;
    this.name = el("h2", { class: "wall-name" }, run.name);
    this.time = el("p", { class: "wall-time" });
    this.reason = el("p", { class: "wall-reason", hidden: true });
    this.progress = el("progress", { class: "wall-progress", max: "1", value: "0", "aria-label": `Simulated time of ${run.name}` });
    this.body = el("div", { class: `wall-body of-${run.plan.test}` });
    this.element = el("section", { class: "wall-test", "aria-label": run.name }, el("div", { class: "wall-head" }, this.name, this.time), this.progress, this.reason, this.body);
    /** @type {View | null} */
    this.view = null;
    this.attempt = 0;
    this.state(run);
    this.#follow();
  }

  #follow() {
    this.following = follow(this.run.id, {
      received: () => this.view?.store.count ?? 0,
      schema: (schema) => {
        if (this.attempt !== schema.attempt || this.view?.store.buckets !== schema.buckets) this.#build(schema);
      },
      frame: (frame) => {
        if (!this.view?.store.take(frame)) return false;
        this.view.redraw();
        return true;
      },
      progress: (progress) => this.state(progress),
      end: (run) => this.state(run),
      link: () => {},
    });
  }

  /** Show the state of the test. @param {any} news parts of the run that have changed */
  state(news) {
    const plan = this.run.plan;
    this.run = { ...this.run, ...news, plan };
    const { state, simulated_s, duration_s } = this.run;
    this.element.dataset.state = state;
    const over = ended(state);
    this.time.textContent = over ? `${state} at ${fixed(simulated_s, 2)} s` : this.run.client?.state === "waiting" ? "waiting for client" : `${fixed(simulated_s ?? 0, 1)}${plan.test === "client" ? "" : ` of ${fixed(duration_s, 1)}`} s`;
    this.progress.hidden = plan.test === "client"; // a client ends its test
    this.progress.value = duration_s ? (simulated_s ?? 0) / duration_s : 0;
    const why = over ? reason(this.run) : null;
    this.reason.hidden = !why;
    this.reason.textContent = why ?? "";
    if (!this.view) return;
    this.view.ended = over;
    this.view.trip = this.run.trip ?? null;
    this.view.redraw();
  }

  /** @param {import("../run/store.js").Schema} schema */
  #build(schema) {
    this.view?.close();
    this.attempt = schema.attempt;
    const store = new Store(schema);
    const view = new View(store);
    this.view = view;
    const { plan } = this.run;
    const [drawing, gauges, loops, strips] = ["schematic", "gauges", "loops", "strips"].map((name) => el("div", { class: `wall-${name}` }));
    this.body.replaceChildren(drawing, gauges, ...(plan.stations.length && this.alone ? [loops] : []), strips);
    const some = plan.stations.slice(0, MOST_LOOPS);
    loops.dataset.loops = String(some.length);
    loops.replaceChildren(...some.map((/** @type {any} */ _, /** @type {number} */ i) => this.#loop(view, i)));
    new TimePanel(strips, view).show(this.#strips(store));
    new Picture(view, plan, this.body, drawing, gauges);
    this.state({});
  }

  /** @param {View} view @param {number} station */
  #loop(view, station) {
    const [x, y] = pair(view.store, this.run.plan, station, ["x_meas", "displacement"], ["f_meas", "force"]);
    return new LoopChart(view, `Station ${station + 1}`, x, y).figure.element;
  }

  /** The displacements of all stations, and their tracking indicators where there is room. @param {Store} store */
  #strips(store) {
    const { plan } = this.run;
    const count = plan.stations.length;
    if (!count) return [...floorStrips(store), ...inputStrips(store, plan)];
    const names = this.alone && count <= FEW && plan.test !== "specimen" ? ["displacement", "ti"] : ["displacement"];
    return plan.stations.slice(0, MOST_LOOPS).flatMap((/** @type {any} */ _, /** @type {number} */ i) =>
      stationStrips(store, plan, i, names, this.declared).map((strip) => ({ ...strip, title: count > 1 ? `${i + 1}: ${strip.title}` : strip.title })),
    );
  }

  close() {
    this.view?.close();
    this.following?.close();
  }
}
