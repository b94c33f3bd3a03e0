// @ts-check
/**
 * One node of the plan's JSON schema, references resolved.
 * @typedef {Record<string, any>} Node
 */

/** Reads the plan's JSON schema: the one source of labels, units, bounds and defaults of the form. */
export class Schema {
  /** @param {Node} root */
  constructor(root) {
    this.root = root;
    this.test = root.properties.test.default;
  }

  /** Whether a field is used in the kind of test chosen. @param {Node} node */
  applies(node) {
    return !node.tests || node.tests.includes(this.test);
  }

  /** The node itself with what its reference and its nullable form hold; `nullable` tells whether null is allowed. @param {Node} node @returns {Node} */
  resolve(node) {
    if (node.$ref) {
      const { $ref, ...own } = node;
      return { ...this.resolve(this.root.$defs[$ref.split("/").pop()]), ...own };
    }
    const rest = node.anyOf?.filter((/** @type {Node} */ option) => option.type !== "null");
    if (rest?.length === 1) {
      const { anyOf, ...own } = node;
      return { ...this.resolve(rest[0]), ...own, nullable: rest.length < anyOf.length };
    }
    return node;
  }

  /** The kinds a union offers, by name. @param {Node} node @returns {Map<string, Node>} */
  kinds(node) {
    const order = node.oneOf.map((/** @type {Node} */ option) => option.$ref);
    const mapping = /** @type {[string, string][]} */ (Object.entries(node.discriminator.mapping));
    mapping.sort(([, a], [, b]) => order.indexOf(a) - order.indexOf(b));
    return new Map(mapping.map(([kind, $ref]) => [kind, this.resolve({ $ref })]));
  }

  /** A value to start from: the default, or the defaults of all fields. @param {Node} node @returns {any} */
  initial(node) {
    const found = this.resolve(node);
    if ("default" in found) return structuredClone(found.default);
    if ("const" in found) return found.const;
    if (found.oneOf) return this.initial(found.oneOf[0]);
    if (found.type === "object") {
      return Object.fromEntries(Object.entries(found.properties).map(([name, property]) => [name, this.initial(property)]));
    }
    if (found.type === "array") return found.minItems && found.items.$ref ? [this.initial(found.items)] : [];
    return found.type === "string" ? "" : null;
  }
}

/** The label of a kind: its title; a bare class name in words, `FrameStorey` as `Frame storey`. @param {Node} node */
export function kindLabel(node) {
  return node.title.replace(/([a-z])([A-Z])/g, (/** @type {string} */ _, /** @type {string} */ a, /** @type {string} */ b) => `${a} ${b.toLowerCase()}`);
}

/** The first line of a description that is prose, which helps in a form; formulas stay in the documentation. @param {Node} node */
export function hintOf(node) {
  return node.description && !node.description.includes("\n") ? node.description : "";
}
