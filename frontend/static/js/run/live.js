// @ts-check
/** @typedef {import("./store.js").Schema} Schema */

/**
 * What a view does with the feed. `received` says from which bucket to go on after a lost connection, or null to begin anew.
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
const REFUSED = 4400; // close codes from here on are the service's own: it will not answer otherwise when asked again

/** Follow the live protocol of one run until its end, across lost connections. @param {string} runId @param {Viewer} viewer */
export function follow(runId, viewer) {
  let delay = FIRST_DELAY_MS;
  let ended = false;
  /** @type {WebSocket} */
  let socket;

  const connect = () => {
    const scheme = location.protocol === "https:" ? "wss" : "ws";
    socket = new WebSocket(`${scheme}://${location.host}/api/v1/runs/${runId}/live?from=${viewer.received()}`);
    socket.binaryType = "arraybuffer";
    socket.onmessage = ({ data }) => {
      if (typeof data === "string") take(JSON.parse(data));
      else if (!viewer.frame(data)) socket.close();
    };
    socket.onclose = ({ code, reason }) => {
      if (ended) return;
      if (code >= REFUSED) return viewer.link("refused", reason);
      viewer.link("reconnecting", "");
      setTimeout(connect, delay * (0.75 + Math.random() / 2));
      delay = Math.min(2 * delay, LONGEST_DELAY_MS);
    };
  };

  const take = (/** @type {any} */ message) => {
    if (message.type === "schema") {
      delay = FIRST_DELAY_MS;
      viewer.link("open", "");
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
}
