// @ts-check

const KEY = "rths.name";

/** The name of the user of this browser, stored with tests that the user submits or stops. */
export const person = () => localStorage.getItem(KEY) ?? "";

/** @param {string} name */
export const remember = (name) => localStorage.setItem(KEY, name);
