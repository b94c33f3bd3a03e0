// @ts-check

/**
 * Create an element with attributes and children. A string child becomes a text node, `on` maps events to listeners,
 * true sets an attribute without a value, and false leaves the attribute out.
 * @param {string} tag
 * @param {Record<string, any>} [attributes]
 * @param {...(Node | string | null | undefined | false)} children
 * @returns {any}
 */
export function el(tag, attributes = {}, ...children) {
  const node = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name === "on") for (const [event, listener] of Object.entries(value)) node.addEventListener(event, listener);
    else if (value === true) node.setAttribute(name, "");
    else if (value !== false && value != null) node.setAttribute(name, String(value));
  }
  node.append(...children.filter((child) => child != null && child !== false).map((child) => /** @type {Node | string} */ (child)));
  return node;
}

/**
 * Show these children in the host and leave those in place that are there already and equal: a link that is replaced
 * while it is pressed loses the click, and a button that is replaced loses the keyboard focus.
 * @param {Element} host
 * @param {...(Node | string)} children
 */
export function renew(host, ...children) {
  const present = [...host.childNodes];
  const shown = children.map((child) => {
    const node = typeof child === "string" ? document.createTextNode(child) : child;
    const at = present.findIndex((one) => one.isEqualNode(node) || unfolded(one)?.isEqualNode(node));
    return at < 0 ? node : present.splice(at, 1)[0];
  });
  for (const gone of present) gone.remove();
  let place = host.firstChild;
  for (const node of shown) {
    if (node === place) place = place.nextSibling;
    else host.insertBefore(node, place);
  }
}

/** An open fold as it is when closed: what a person has opened stays open. @param {Node} node */
function unfolded(node) {
  if (!(node instanceof HTMLDetailsElement) || !node.open) return null;
  const closed = /** @type {HTMLDetailsElement} */ (node.cloneNode(true));
  closed.open = false;
  return closed;
}

/** @param {string} id @returns {any} */
export function byId(id) {
  const node = document.getElementById(id);
  if (!node) throw new Error(`The page has no element #${id}.`);
  return node;
}

/** The colour of a CSS custom property in the current theme, as the browser resolves it. @param {string} name */
export function colour(name) {
  const probe = document.createElement("span");
  probe.style.color = `var(${name})`;
  document.body.append(probe);
  const found = getComputedStyle(probe).color;
  probe.remove();
  return found;
}

/** The HTML elements of a collection, as an array. @param {Iterable<Element>} some */
export const htmlElements = (some) => [...some].filter((one) => one instanceof HTMLElement);
