// @ts-check
import { api, explain } from "../api.js";
import { byId } from "../dom.js";

/** @typedef {{name: string, address: string, signatures: string[], logo: {media_type: string, size: number, sha256: string} | null}} Laboratory */

const said = byId("laboratory-said");

/** @param {Event} event */
async function save(event) {
  event.preventDefault();
  byId("laboratory-refusal").textContent = said.textContent = "";
  const roles = byId("laboratory-signatures").value.split("\n").map((/** @type {string} */ role) => role.trim());
  try {
    await api.put("/laboratory", {
      name: byId("laboratory-name").value.trim(),
      address: byId("laboratory-address").value.trim(),
      signatures: roles.filter(Boolean),
    });
    said.textContent = "Saved. The next report shows it.";
  } catch (error) {
    byId("laboratory-refusal").textContent = explain(error);
  }
}

/** @param {Laboratory} laboratory */
function showLogo({ logo }) {
  const image = byId("logo");
  if (logo) image.src = `/api/v1/laboratory/logo?${logo.sha256.slice(0, 12)}`;
  image.hidden = !logo;
  byId("logo-none").hidden = Boolean(logo);
  byId("logo-remove").hidden = !logo;
}

/** @param {() => Promise<Laboratory>} change */
async function changeLogo(change) {
  byId("logo-refusal").textContent = "";
  try {
    showLogo(await change());
  } catch (error) {
    byId("logo-refusal").textContent = explain(error);
  }
  byId("logo-file").value = "";
}

byId("laboratory").addEventListener("submit", save);
byId("logo-file").addEventListener("change", () => {
  const [file] = byId("logo-file").files;
  const form = new FormData();
  form.append("file", file);
  if (file) void changeLogo(() => api.putForm("/laboratory/logo", form));
});
byId("logo-remove").addEventListener("click", () => changeLogo(async () => {
  await api.remove("/laboratory/logo");
  return api.get("/laboratory");
}));
