// @ts-check
import { api, explain } from "../api.js";
import { byId } from "../dom.js";
import { plotsOf } from "./plots.js";
import { removal } from "./remove.js";

const host = byId("plots");
removal(() => location.assign("/recordings"));

try {
  const address = `/recordings/${host.dataset.id}/preview`;
  const part = (/** @type {number} */ from, /** @type {number} */ to) => api.get(`${address}?from_s=${from}&to_s=${to}`);
  host.replaceChildren(plotsOf(await api.get(address), part));
} catch (error) {
  byId("refusal").textContent = explain(error);
  host.replaceChildren();
}
