// @ts-check
const SPACE = "http://www.w3.org/2000/svg";

/** Create an SVG element with attributes and children. A string child becomes a text node. @param {string} tag @param {Record<string, string | number>} [attributes] @param {...(Node | string)} children @returns {any} */
export function svg(tag, attributes = {}, ...children) {
  const node = document.createElementNS(SPACE, tag);
  change(node, attributes);
  node.append(...children);
  return node;
}

/** Set attributes of an element. @param {Element} node @param {Record<string, string | number>} attributes */
export function change(node, attributes) {
  for (const [name, value] of Object.entries(attributes)) node.setAttribute(name, String(value));
}

/** Move an element by x and y pixels. @param {Element} node @param {number} x @param {number} [y] */
export const move = (node, x, y = 0) => node.setAttribute("transform", `translate(${x.toFixed(2)} ${y.toFixed(2)})`);

/** A line as an SVG element. @param {string} kind @param {number} x1 @param {number} y1 @param {number} x2 @param {number} y2 */
export const line = (kind, x1, y1, x2, y2) => svg("line", { class: kind, x1, y1, x2, y2 });

/** A text as an SVG element. @param {string} kind @param {number} x @param {number} y @param {string} words */
export const text = (kind, x, y, words) => svg("text", { class: kind, x, y }, words);

/** Hatching below the line from x1 to x2 at height y, as path data. @param {number} x1 @param {number} x2 @param {number} y @param {number} [depth] */
export function hatched(x1, x2, y, depth = 7) {
  let path = `M${x1} ${y}H${x2}`;
  for (let x = x1 + depth; x <= x2; x += depth) path += `M${x} ${y}l${-depth} ${depth}`;
  return path;
}
