// @ts-check

const KEY = "rths.name";

/** The account that is signed in, whose name is stored whatever this browser sends. Without accounts: null. */
export const account = () => document.body.dataset.person ?? null;

/** The name of the user of this browser, stored with tests that the user submits or stops. */
export const person = () => account() ?? localStorage.getItem(KEY) ?? "";

/** @param {string} name */
export const remember = (name) => account() === null && localStorage.setItem(KEY, name);
