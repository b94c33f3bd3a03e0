// @ts-check
const WIDTH = 690; // CSS pixels: an A4 page less its margins
const CLASS = "printing";

/**
 * Draw every chart for a print, seen or not, in the light theme and at the width of the page; afterwards as before.
 * @param {() => void} drawAll
 */
export function printsAll(drawAll) {
  const root = document.documentElement;
  /** @type {string | undefined} */
  let theme;
  const begin = () => {
    if (root.classList.contains(CLASS)) return;
    theme = root.dataset.theme;
    root.dataset.theme = "light";
    root.classList.add(CLASS);
    root.style.setProperty("--print-width", `${WIDTH}px`);
    document.dispatchEvent(new Event("themechange"));
    drawAll();
  };
  const end = () => {
    if (!root.classList.contains(CLASS)) return;
    root.classList.remove(CLASS);
    if (theme === undefined) delete root.dataset.theme;
    else root.dataset.theme = theme;
    document.dispatchEvent(new Event("themechange"));
    drawAll();
  };
  addEventListener("beforeprint", begin);
  addEventListener("afterprint", end);
  matchMedia("print").addEventListener("change", ({ matches }) => (matches ? begin() : end()));
}
