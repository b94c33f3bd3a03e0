// @ts-check
/**
 * One node of the plan's JSON schema with its references resolved.
 * @typedef {Record<string, any>} Node
 */

/** Reads the plan's JSON schema, the only source of the form's labels, units, bounds and defaults. */
export class Schema {
  /** @param {Node} root */
  constructor(root) {
    this.root = root;
    this.test = root.properties.test.default;
  }

  /** Whether the selected kind of test uses a field. @param {Node} node */
  applies(node) {
    return !node.tests || node.tests.includes(this.test);
  }

  /** The node merged with its reference and its non-null option; `nullable` is true if null is allowed. @param {Node} node @returns {Node} */
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

  /** The kinds of a union by name. @param {Node} node @returns {Map<string, Node>} */
  kinds(node) {
    const order = node.oneOf.map((/** @type {Node} */ option) => option.$ref);
    const mapping = /** @type {[string, string][]} */ (Object.entries(node.discriminator.mapping));
    mapping.sort(([, a], [, b]) => order.indexOf(a) - order.indexOf(b));
    return new Map(mapping.map(([kind, $ref]) => [kind, this.resolve({ $ref })]));
  }

  /** The initial value: the default, or the defaults of all fields. @param {Node} node @returns {any} */
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

/** The label of a kind: its title. A class name is split into words: `FrameStorey` gives `Frame storey`. @param {Node} node */
export function kindLabel(node) {
  return node.title.replace(/([a-z])([A-Z])/g, (/** @type {string} */ _, /** @type {string} */ a, /** @type {string} */ b) => `${a} ${b.toLowerCase()}`);
}

/** The hint of a field: its description if it is a single line. Longer descriptions with formulas are for the documentation. @param {Node} node */
export function hintOf(node) {
  return node.description && !node.description.includes("\n") ? node.description : "";
}
