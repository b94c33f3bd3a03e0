// @ts-check
/** @typedef {import("./view.js").View} View */

const STEP = 2; // pixels
const LONG_STEP = 20; // with Shift

/** Move the cursor of a time chart and zoom by the keyboard. @param {KeyboardEvent} event @param {any} plot of uPlot @param {View} view */
export function zoomKey(event, plot, view) {
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  const [from, to] = view.range();
  const width = plot.over.clientWidth;
  const { left: cursor = -1 } = plot.cursor;
  const left = cursor >= 0 ? cursor : width / 2;
  const zoom = (/** @type {number} */ factor) => {
    const centre = plot.posToVal(left, "x");
    view.zoomTo([Math.max(0, centre - (centre - from) * factor), Math.min(view.end, centre + (to - centre) * factor)]);
  };
  const step = event.shiftKey ? LONG_STEP : STEP;
  if (event.key === "ArrowLeft" || event.key === "ArrowRight") {
    const next = Math.min(width, Math.max(0, left + (event.key === "ArrowLeft" ? -step : step)));
    plot.setCursor({ left: next, top: 10 });
  } else if (event.key === "+" || event.key === "=") zoom(0.5);
  else if (event.key === "-") zoom(2);
  else if (event.key === "Escape") view.zoomTo(null);
  else return;
  event.preventDefault();
}
