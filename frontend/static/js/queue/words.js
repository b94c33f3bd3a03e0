// @ts-check
// Times of the queue in words.
import { significant } from "../format.js";

/** A time in its two largest units: `3 min 20 s`. @param {number | null | undefined} seconds */
export function span(seconds) {
  if (seconds == null) return "–";
  if (seconds < 60) return `${significant(seconds)} s`;
  const whole = Math.round(seconds);
  const [hours, minutes, rest] = [Math.floor(whole / 3600), Math.floor((whole % 3600) / 60), whole % 60];
  return hours ? `${hours} h ${minutes} min` : `${minutes} min ${rest} s`;
}

/** The time of day of a moment, and its date where that is another day. @param {string | null | undefined} iso */
export function clock(iso) {
  if (!iso) return "–";
  const date = new Date(iso);
  const time = date.toLocaleTimeString("en-GB");
  return date.toDateString() === new Date().toDateString() ? time : `${date.toLocaleDateString("en-CA")} ${time}`;
}

/** @param {number | null} pace */
export function paceWords(pace) {
  if (pace == null) return "as fast as possible";
  return pace === 1 ? "real time" : `${significant(pace)} × real time`;
}

/** @param {number} count @param {string} noun */
export const counted = (count, noun) => `${count} ${noun}${count === 1 ? "" : "s"}`;
