// @ts-check
import { byId } from "../dom.js";
import { noteSignIn } from "../signed_out.js";

const KEY = "rths.seen";
const AWAY_MS = 10 * 60_000; // shorter absences are the same visit

/** Show what happened since this browser last showed the Lab page, and note that it does now. */
export async function showSince() {
  const before = localStorage.getItem(KEY);
  const seen = () => document.visibilityState === "visible" && localStorage.setItem(KEY, new Date().toISOString());
  seen();
  setInterval(seen, 30_000);
  addEventListener("pagehide", seen);
  if (!before || Date.now() - Date.parse(before) < AWAY_MS) return;
  const answer = noteSignIn(await fetch(`/lab/since?moment=${encodeURIComponent(before)}`));
  if (!answer.ok) return;
  const host = byId("since");
  host.replaceChildren(...new DOMParser().parseFromString(await answer.text(), "text/html").body.childNodes);
  host.hidden = false;
}
