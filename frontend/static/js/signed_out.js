// @ts-check
// What an open page says once the sign-in of its person has ended: why, and a link to the sign-in page, which leads back here. The
// page stays as it is, with what was typed. After a sign-in in another tab the notice goes, and the page works again.
import { el } from "./dom.js";

const ENDED = "your session has ended";
/** @type {HTMLElement | null} */
let notice = null;

/** A link to the sign-in page, which leads back to this page. @param {string} words @returns {HTMLElement} */
export const signInLink = (words) => el("a", { href: `/sign-in?to=${encodeURIComponent(location.pathname + location.search + location.hash)}` }, words);

/** Say that the sign-in has ended, once, and why. */
export function signedOut(why = ENDED) {
  if (notice || location.pathname.startsWith("/sign-in")) return;
  const words = el("p", { role: "alert" });
  const shown = el("aside", { class: "signed-out", "aria-label": "Sign-in" }, words);
  document.querySelector("main")?.before(shown);
  notice = shown;
  words.append(`You are signed out: ${why}. `, signInLink("Sign in and return to this page"));
}

/** Look at an answer of the service, whoever asked for it. @param {Response} response */
export function noteSignIn(response) {
  if (response.status === 401) signedOut();
  else if (notice && response.status < 500) {
    notice.remove();
    notice = null;
    document.dispatchEvent(new Event("signedin"));
  }
  return response;
}

/** Ask whether the person is still signed in, where a live view has ended. @param {string} why */
export async function checkSignIn(why) {
  const answer = await fetch("/api/v1/account").catch(() => null);
  if (answer?.status === 401) signedOut(why || ENDED);
}
