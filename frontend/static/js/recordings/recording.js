// @ts-check
import { api, explain } from "../api.js";
import { byId } from "../dom.js";
import { plotsOf } from "./plots.js";
import { removal } from "./remove.js";

const host = byId("plots");
removal(() => location.assign("/recordings"));

try {
  host.replaceChildren(plotsOf(await api.get(`/recordings/${host.dataset.id}/preview`)));
} catch (error) {
  byId("refusal").textContent = explain(error);
  host.replaceChildren();
}
