// @ts-check
// A dialog that asks before something that cannot be undone.
import { el } from "./dom.js";

let count = 0;

/**
 * Ask a question; resolves to whether the person chose the action. Escape keeps everything as it is.
 * @param {{title: string, text: string, action: string, keep: string}} words
 * @returns {Promise<boolean>}
 */
export function confirmed({ title, text, action, keep }) {
  const id = `confirm-${++count}`;
  const yes = el("button", { type: "button", class: "danger" }, action);
  const no = el("button", { type: "button", class: "quiet", autofocus: true }, keep);
  const dialog = el(
    "dialog",
    { class: "confirm", "aria-labelledby": id, "aria-describedby": `${id}-text` },
    el("article", {}, el("h2", { id }, title), el("p", { id: `${id}-text` }, text), el("div", { class: "actions" }, no, yes)),
  );
  document.body.append(dialog);
  return new Promise((resolve) => {
    yes.addEventListener("click", () => dialog.close("yes"));
    no.addEventListener("click", () => dialog.close());
    dialog.addEventListener("close", () => {
      resolve(dialog.returnValue === "yes");
      dialog.remove();
    });
    dialog.showModal();
  });
}

/** Ask before a running test is cancelled. @param {{number: number, name: string}} run */
export const cancelConfirmed = (run) =>
  confirmed({
    title: `Cancel run ${run.number}?`,
    text: `“${run.name}” is running. It stops within a second and cannot go on later. The samples so far are stored.`,
    action: "Cancel the test",
    keep: "Keep it running",
  });
