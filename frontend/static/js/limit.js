// @ts-check
import { ApiError } from "./api.js";
import { size } from "./format.js";

/** The file, unless it is larger than the page's `data-limit-mb`: a browser would send all of it before it heard the refusal. @param {File} file */
export function withinLimit(file) {
  const page = /** @type {HTMLElement} */ (document.querySelector("[data-limit-mb]"));
  const most = Number(page.dataset.limitMb);
  if (file.size > most * 1e6) throw new ApiError(413, `${file.name} has ${size(file.size)}; ${most} MB is the most that is taken.`);
  return file;
}
