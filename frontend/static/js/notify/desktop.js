// @ts-check
// Notifications on the desktop, after a click that asks for them. They appear while the page is in the background.
import { el } from "../dom.js";

const WANTED = "rths.desktop";
const offered = "Notification" in window;
const wanted = () => offered && Notification.permission === "granted" && localStorage.getItem(WANTED) === "yes";

/** What turns desktop notifications on or off, or says why they cannot be. */
export function desktopControl() {
  const host = el("p", {});
  show(host);
  return host;
}

/** @param {any} host */
function show(host) {
  if (!offered || Notification.permission === "denied") {
    host.replaceChildren(
      el("span", { class: "muted" }, "This browser does not allow desktop notifications of this address. Allow them in its site settings."),
    );
    return;
  }
  const act = el("button", { type: "button", class: "quiet small" }, wanted() ? "Stop desktop notifications" : "Show desktop notifications");
  act.addEventListener("click", async () => {
    const on = !wanted() && (await Notification.requestPermission()) === "granted";
    localStorage.setItem(WANTED, on ? "yes" : "no");
    show(host);
  });
  host.replaceChildren(act);
}

/** @param {{number: number, kind: string, name: string, sentence: string, run_id: string | null}} event */
export function tellDesktop(event) {
  if (!wanted() || !document.hidden) return;
  const note = new Notification(`${event.name || "Test"}: ${event.kind}`, { body: event.sentence, tag: `rths-${event.number}` });
  note.onclick = () => {
    window.focus();
    if (event.run_id) location.assign(`/runs/${event.run_id}`);
  };
}
