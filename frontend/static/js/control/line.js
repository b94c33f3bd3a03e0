// @ts-check
// One quiet line for each rig: who drives it, and how to get its control. Hidden while the laboratory has no such rule.
import { api, explain } from "../api.js";
import { el, renew } from "../dom.js";
import { person } from "../person.js";
import { keepingFocus } from "./focus.js";
import { asked } from "./reason.js";

/** @typedef {{rig_id: string, rig_name: string, driver: string | null, until: string | null, asked_by: string | null, yours: boolean, sentence: string}} Driven */

const POLL_MS = 5000;
const OFF_MS = 60_000; // while the rule is off
const RENEW_MS = 60_000;

/**
 * Show who drives the rigs that `wanted` chooses, and keep the control of the reader while the page is visible. Returns how to look at once.
 * @param {HTMLElement} host @param {(rig: Driven) => boolean} wanted
 * @param {{controls?: boolean, told?: (control: import("./withheld.js").Control) => void}} [options] `told` hears what the service says
 */
export function controlLine(host, wanted, { controls = true, told = () => undefined } = {}) {
  let renewed = 0;
  let note = "";

  /** @param {Driven} rig @param {string} what @param {object} [more] */
  async function act(rig, what, more = {}) {
    try {
      await api.post(`/control/${rig.rig_id}/${what}`, { by: person(), ...more });
      note = what === "request" ? `${rig.driver} sees that you ask.` : "";
    } catch (error) {
      note = explain(error);
    }
    await show();
  }

  /** @param {string} label @param {() => unknown} click */
  const button = (label, click, needs = "operator") => el("button", { type: "button", class: "quiet small", "data-needs": needs, on: { click } }, label);

  /** @param {Driven} rig @param {boolean} may_take_over */
  function buttons(rig, may_take_over) {
    if (rig.yours)
      return [
        ...(rig.asked_by ? [button(`Hand over to ${rig.asked_by}`, () => act(rig, "hand-over", { to: rig.asked_by }))] : []),
        button("Give up the control", () => act(rig, "release")),
      ];
    if (!rig.driver) return [button("Take the control", () => act(rig, "take"))];
    const over = async () => {
      const reason = await asked(`Take over ${rig.rig_name} from ${rig.driver}`, "Reason, which the audit log keeps", "Take over the rig");
      if (reason) await act(rig, "take-over", { reason });
    };
    return [
      ...(rig.asked_by === person() ? [] : [button("Ask for the control", () => act(rig, "request"))]),
      ...(may_take_over ? [button("Take over …", over, "administrator")] : []),
    ];
  }

  /** @param {Driven} rig @param {boolean} may_take_over */
  function line(rig, may_take_over) {
    const until = rig.until ? new Date(rig.until).toTimeString().slice(0, 5) : "";
    const words = controls && rig.yours
      ? `You drive ${rig.rig_name} until ${until}, longer while this page is open.`
      : rig.driver
        ? `${rig.driver} drives ${rig.rig_name} until ${until}.`
        : rig.sentence;
    const asks = rig.asked_by && controls ? ` ${rig.asked_by} asks for the control.` : "";
    return el("p", {}, el("span", {}, `${words}${asks}`), ...(controls ? buttons(rig, may_take_over) : []));
  }

  async function show() {
    const control = await api.get(`/control?by=${encodeURIComponent(person())}`);
    const { one_driver, may_take_over, rigs } = control;
    told(control);
    host.hidden = !one_driver;
    if (!one_driver) return OFF_MS;
    const chosen = rigs.filter(wanted);
    const lines = chosen.map((/** @type {Driven} */ rig) => line(rig, may_take_over));
    keepingFocus(host, () => renew(host, ...lines, ...(note && lines.length ? [el("p", { class: "note" }, note)] : [])));
    const mine = rigs.filter((/** @type {Driven} */ { yours }) => yours);
    if (controls && mine.length && document.visibilityState === "visible" && Date.now() - renewed > RENEW_MS) {
      renewed = Date.now();
      for (const rig of mine) await api.post(`/control/${rig.rig_id}/renew`, { by: person() });
    }
    return POLL_MS;
  }

  async function poll() {
    const again = await show().catch(() => POLL_MS);
    setTimeout(poll, again);
  }
  void poll();
  return () => {
    note = "";
    void show().catch(() => undefined);
  };
}
