// @ts-check

/** A number as typed, or the text itself where it is a number with a unit. @param {string} text @returns {number | string} */
export function typed(text) {
  const plain = text.trim().replaceAll("−", "-");
  return plain !== "" && Number.isFinite(Number(plain)) ? Number(plain) : text.trim();
}

/** Values of a list: `1, 2, 3` or `1 mm; 2 mm`. @param {string} text */
export const listed = (text) => text.split(/[,;\n]/).map((one) => one.trim()).filter(Boolean).map(typed);

/** A list, or a range written as `0.1 to 1 in 10`. @param {string} text */
export function listOrRange(text) {
  const range = text.match(/^\s*(\S+)\s+to\s+(\S+)\s+in\s+(\d+)\s*$/);
  return range ? { range: { from: typed(range[1]), to: typed(range[2]), count: Number(range[3]) } } : { values: listed(text) };
}

/** A number without the noise of its last digits. @param {number} value */
export const tidy = (value) => String(Number(value.toPrecision(8)));
