// @ts-check
import { number } from "../format.js";

/** What a sampling rate means for a file, so that a wrong unit is seen. @param {number} hertz @param {number} samples of the file, 0: not known */
export function rateSays(hertz, samples) {
  const lasts = samples > 1 ? `: ${samples} samples last ${number((samples - 1) / hertz)} s` : "";
  return `${number(hertz)} Hz, ${number(1e3 / hertz)} ms${lasts}`;
}
