// @ts-check
import { el } from "../dom.js";

/**
 * Keys of the pages, for the list behind "?": where they work (`at` matches the path of a page), the keys, and what they do.
 * @type {{at: RegExp, where: string, keys: [string[], string][]}[]}
 */
const SHORTCUTS = [
  { at: /^/, where: "Every page", keys: [[["?"], "show shortcuts and terms of the page"], [["Esc"], "close what is open; disarm Abort"]] },
  {
    at: /^\/runs\/[^/]+$/,
    where: "A run, with the focus on a chart",
    keys: [
      [["←", "→"], "move the cursor; with Shift in long steps"],
      [["+", "−"], "zoom in and out"],
      [["Esc"], "show the whole test"],
      [["Space"], "hold or replay the test"],
      [["N"], "write a note at the cursor"],
    ],
  },
  {
    at: /^\/runs$/,
    where: "The run table",
    keys: [
      [["/"], "search"],
      [["↑", "↓"], "move between runs"],
      [["Space"], "select or deselect a run"],
      [["Enter"], "open the run"],
      [["Esc"], "clear the selection"],
      [["Shift+←", "Shift+→"], "move a column, with the focus on its head"],
    ],
  },
  { at: /^\/new$/, where: "New test", keys: [[["Ctrl+Enter"], "queue the test"]] },
  { at: /^\/compare$/, where: "A comparison, with the focus on a chart", keys: [[["←", "→"], "move the cursor"], [["+", "−"], "zoom in and out"], [["Esc"], "show everything"]] },
  { at: /^\/recordings/, where: "Samples of a file", keys: [[["+", "−"], "zoom in and out"], [["Esc"], "show the whole file"]] },
];

/** The shortcuts of a page, or of all pages, as terms of a list. @param {string | null} path @returns {HTMLElement[]} */
export function shortcutList(path) {
  return SHORTCUTS.filter(({ at }) => path === null || at.test(path)).flatMap(({ where, keys }) => [
    el("dt", { class: "where" }, where),
    ...keys.map(([some, does]) => el("dd", {}, ...some.flatMap((key, i) => (i ? [" ", el("kbd", {}, key)] : [el("kbd", {}, key)])), ` ${does}`)),
  ]);
}
