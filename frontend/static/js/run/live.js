// @ts-check
import { checkSignIn } from "../signed_out.js";

/** @typedef {import("./store.js").Schema} Schema */

/**
 * The handlers of a live feed. `received` gives the first missing bucket, from which the feed continues after a lost connection.
 * @typedef {{
 *   schema: (schema: Schema) => void,
 *   frame: (frame: ArrayBuffer) => boolean,
 *   progress: (progress: any) => void,
 *   end: (run: any) => void,
 *   link: (state: "open" | "reconnecting" | "refused", reason: string) => void,
 *   received: () => number,
 * }} Viewer
 */

const FIRST_DELAY_MS = 300;
const LONGEST_DELAY_MS = 8000;
const NOT_ALLOWED = 4403; // the sign-in has ended, or the role does not suffice any longer
const REFUSED = 4400; // the service's own close codes start here: a new connection would get the same answer

/** Follow the live feed of one run until its end or until it is closed, and reconnect when the connection is lost. @param {string} runId @param {Viewer} viewer */
export function follow(runId, viewer) {
  let delay = FIRST_DELAY_MS;
  let ended = false;
  let open = false;
  /** @type {WebSocket} */
  let socket;

  const connect = () => {
    if (ended) return;
    open = false;
    const scheme = location.protocol === "https:" ? "wss" : "ws";
    socket = new WebSocket(`${scheme}://${location.host}/api/v1/runs/${runId}/live?from=${viewer.received()}`);
    socket.binaryType = "arraybuffer";
    socket.onmessage = ({ data }) => {
      if (typeof data === "string") take(JSON.parse(data));
      else if (!viewer.frame(data)) socket.close();
    };
    socket.onclose = ({ code, reason }) => {
      if (ended) return;
      if (code === NOT_ALLOWED) {
        document.addEventListener("signedin", connect, { once: true });
        void checkSignIn(reason);
      }
      if (code >= REFUSED) return viewer.link("refused", reason);
      viewer.link("reconnecting", "");
      setTimeout(connect, delay * (0.75 + Math.random() / 2));
      delay = Math.min(2 * delay, LONGEST_DELAY_MS);
    };
  };

  const take = (/** @type {any} */ message) => {
    if (!open) {
      open = true;
      delay = FIRST_DELAY_MS;
      viewer.link("open", "");
    }
    if (message.type === "schema") {
      viewer.schema(message);
    } else if (message.type === "progress") {
      viewer.progress(message);
    } else if (message.type === "end") {
      ended = true;
      viewer.end(message.run);
      socket.close();
    }
  };

  connect();
  return {
    close() {
      ended = true;
      socket.close();
    },
  };
}
