// @ts-check

const KEY = "rths.name";

/** The name under which this browser's reader submits and stops tests. */
export const person = () => localStorage.getItem(KEY) ?? "";

/** @param {string} name */
export const remember = (name) => localStorage.setItem(KEY, name);
