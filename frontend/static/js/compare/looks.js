// @ts-check
// 20 items that can be told apart: five colours that colour-blind people distinguish, times four kinds of line.

const COLOURS = ["--curve-1", "--curve-2", "--curve-3", "--curve-4", "--curve-5"];
const DASHES = [[], [7, 3], [2, 2.5], [9, 3, 2, 3]];

/** Colour and dashes of an item. @param {number} item */
export const look = (item) => ({
  colour: COLOURS[item % COLOURS.length],
  dash: DASHES[Math.floor(item / COLOURS.length) % DASHES.length],
});
