// @ts-check

/**
 * A measure as declared by the service (`measures` of `/api/v1/schema`).
 * @typedef {{key: string, label: string, shown_label: string, decimals: number, scope: "station" | "floor" | "run", tests: string[], meaning: string, formula: string, further: boolean}} Measure
 */

/** The measures of a scope that apply to a kind of test. @param {Measure[]} measures @param {Measure["scope"]} scope @param {string} test */
export const of = (measures, scope, test) => measures.filter((one) => one.scope === scope && one.tests.includes(test));

/** A measure's label with its unit. @param {Measure} measure */
export const heading = ({ label, shown_label }) => (shown_label ? `${label}, ${shown_label}` : label);

/** The meaning and the formula of a measure, for a tooltip. @param {Measure} measure */
export const meaning = ({ meaning, formula }) => `${meaning}: ${formula}`;
