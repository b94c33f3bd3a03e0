// @ts-check
import { ApiError } from "./api.js";
import { size } from "./format.js";

/** The file, if it is not larger than the page's `data-limit-mb`. Without this check, a browser sends the whole file before it reads the refusal. @param {File} file */
export function withinLimit(file) {
  const page = /** @type {HTMLElement} */ (document.querySelector("[data-limit-mb]"));
  const most = Number(page.dataset.limitMb);
  if (file.size > most * 1e6) throw new ApiError(413, `${file.name} is too large: ${size(file.size)}. The largest accepted size is ${most} MB.`);
  return file;
}
