// @ts-check
import { loading } from "./ready.js";
import { noteSignIn } from "./signed_out.js";

/** @typedef {{where: string, problem: string, value?: any, fix?: string | null, lines?: {number: number, text: string}[]}} Problem */

const SIGNED_OUT = "You are signed out. Sign in, then try again.";

/** An error response of the service. Status 0: the service did not answer. */
export class ApiError extends Error {
  /** @param {number} status @param {string} message @param {Problem[]} errors */
  constructor(status, message, errors = []) {
    super(message);
    this.status = status;
    this.errors = errors;
  }
}

/** @param {Problem} problem */
export function sentence({ where, problem, fix }) {
  return [where && `${where}: `, problem, fix && ` (${fix})`].filter(Boolean).join("");
}

/** @param {string} path @param {RequestInit} [init] @returns {Promise<Response>} */
async function request(path, init) {
  let response;
  try {
    response = noteSignIn(await fetch(`/api/v1${path}`, init));
  } catch (error) {
    if (error instanceof DOMException && error.name === "AbortError") throw error;
    throw new ApiError(0, "The service does not answer. Check that the service runs and that this computer is connected to it.");
  }
  if (response.ok) return response;
  if (response.status === 401 && !location.pathname.startsWith("/sign-in")) throw new ApiError(401, SIGNED_OUT);
  const body = await response.json().catch(() => ({}));
  const errors = Array.isArray(body.errors) ? body.errors : [];
  throw new ApiError(response.status, body.detail || body.title || `The service answered with the HTTP status ${response.status}.`, errors);
}

/** @param {any} data @param {AbortSignal} [signal] @returns {RequestInit} */
const json = (data, signal) => ({
  method: "POST",
  body: JSON.stringify(data),
  headers: { "Content-Type": "application/json" },
  signal,
});

export const api = {
  /** @param {string} path @param {AbortSignal} [signal] @returns {Promise<any>} */
  get: (path, signal) => loading(request(path, { signal }).then((answer) => answer.json())),
  /** @param {string} path @param {any} data @param {AbortSignal} [signal] @returns {Promise<any>} */
  post: async (path, data = {}, signal = undefined) => (await request(path, json(data, signal))).json(),
  /** A change whose answer has no body. @param {string} path @param {any} data */
  send: async (path, data) => void (await request(path, json(data))),
  /** @param {string} path @param {any} data @returns {Promise<any>} */
  patch: async (path, data) => (await request(path, { ...json(data), method: "PATCH" })).json(),
  /** With `keepalive`, which browsers allow up to 64 KiB, the request outlives the page. @param {string} path @param {any} data @returns {Promise<any>} */
  put: async (path, data, keepalive = false) => (await request(path, { ...json(data), method: "PUT", keepalive })).json(),
  /** @param {string} path @param {FormData} form @returns {Promise<any>} */
  putForm: async (path, form) => (await request(path, { method: "PUT", body: form })).json(),
  /** @param {string} path */
  remove: async (path) => void (await request(path, { method: "DELETE" })),
  /** @param {string} path @param {any} data @returns {Promise<string>} */
  postForText: async (path, data) => (await request(path, json(data))).text(),
  /** @param {string} path @param {string} text @param {string} type @returns {Promise<any>} */
  postText: async (path, text, type) =>
    (await request(path, { method: "POST", body: text, headers: { "Content-Type": type } })).json(),
  /** @param {string} path @param {FormData} form @returns {Promise<any>} */
  postForm: async (path, form) => (await request(path, { method: "POST", body: form })).json(),
};

/** @param {unknown} error @returns {string} */
export function explain(error) {
  if (!(error instanceof ApiError)) return error instanceof Error ? error.message : String(error);
  return error.errors.length ? error.errors.map(sentence).join("; ") : error.message;
}
