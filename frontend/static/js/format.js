// @ts-check

/** A number with `digits` significant digits, without exponent where it reads well. @param {number | null | undefined} value */
export function number(value, digits = 4) {
  if (value == null || !Number.isFinite(value)) return "–";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e6 || size < 1e-3) return value.toExponential(digits - 1);
  const decimals = Math.max(0, Math.min(digits - 1, digits - 1 - Math.floor(Math.log10(size))));
  return value.toFixed(decimals);
}

/** A number with at most `digits` significant digits, without trailing zeros. @param {number} value */
export const significant = (value, digits = 3) => String(Number(value.toPrecision(digits)));

/** A value read off a chart: like `number`, but a value below 0.001 is shown with three decimals. @param {number | null | undefined} value */
export function reading(value) {
  return value != null && Math.abs(value) < 1e-3 ? fixed(value, 3) : number(value);
}

/** A number with fixed decimals; zero after rounding has no sign. @param {number | null | undefined} value */
export function fixed(value, decimals = 1) {
  if (value == null || !Number.isFinite(value)) return "–";
  const text = value.toFixed(decimals);
  return Number(text) === 0 ? text.replace("-", "") : text;
}

/** Date and time in the time zone of the browser. @param {string | null | undefined} iso */
export function when(iso) {
  if (!iso) return "–";
  const date = new Date(iso);
  const two = (/** @type {number} */ n) => String(n).padStart(2, "0");
  return (
    `${date.getFullYear()}-${two(date.getMonth() + 1)}-${two(date.getDate())} ` +
    `${two(date.getHours())}:${two(date.getMinutes())}:${two(date.getSeconds())}`
  );
}

/** @param {number} bytes */
export function size(bytes) {
  return bytes < 1e6 ? `${(bytes / 1e3).toFixed(0)} kB` : `${(bytes / 1e6).toFixed(1)} MB`;
}
