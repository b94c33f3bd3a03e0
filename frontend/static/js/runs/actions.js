// @ts-check
import { api, explain } from "../api.js";
import { byId } from "../dom.js";
import { toast } from "./toast.js";

/** @typedef {{id: string, number: number}} Some */
/** @type {Record<string, string>} */
const DONE = { archive: "archived", unarchive: "shown again", delete: "deleted", restore: "restored", tag: "tagged", untag: "untagged" };
// the opposite of adding tags would also remove those that a run had before
/** @type {Record<string, string>} */
const UNDO = { archive: "unarchive", unarchive: "archive", delete: "restore" };

/** Do one action on runs, say what was done, and offer to undo it. @param {string} action @param {Some[]} runs @param {() => Promise<void>} reload @param {string[]} [tags] */
export async function act(action, runs, reload, tags = []) {
  try {
    const { changed, refused } = await api.post("/runs/bulk", { action, runs: runs.map((one) => one.id), ...(tags.length ? { tags } : {}) });
    await reload();
    const which = changed.length === 1 ? `Run #${runs.find((one) => one.id === changed[0])?.number}` : `${changed.length} runs`;
    const kept = action === "delete" && changed.length ? " It can be restored for 7 days.".replace("It", changed.length === 1 ? "It" : "They") : "";
    const words = [changed.length && `${which} ${DONE[action]}.${kept}`, ...refused.slice(0, 3).map((/** @type {any} */ one) => one.reason), refused.length > 3 && `${refused.length - 3} more are not changed.`];
    const some = runs.filter((one) => changed.includes(one.id));
    const undo = UNDO[action] && changed.length ? () => void act(UNDO[action], some, reload, tags) : null;
    toast(words.filter(Boolean).join(" "), undo, refused.length > 0);
  } catch (error) {
    toast(`Nothing is changed: ${explain(error)}`, null, true);
  }
}

/** Ask for tags and add them to runs. @param {Some[]} runs @param {string} action tag or untag @param {() => Promise<void>} reload */
export function askTags(runs, action, reload) {
  byId("tags-title").textContent = `${action === "tag" ? "Add tags to" : "Remove tags from"} ${runs.length === 1 ? `run #${runs[0].number}` : `${runs.length} runs`}`;
  byId("tags-input").value = "";
  byId("tags-form").onsubmit = () => {
    const tags = byId("tags-input").value.split(",").map((/** @type {string} */ one) => one.trim()).filter(Boolean);
    if (tags.length) void act(action, runs, reload, tags);
  };
  byId("tags-dialog").showModal();
}
