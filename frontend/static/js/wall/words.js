// @ts-check

/** The state of the laboratory in words, and its name for the style. @param {any} queue @param {any[]} running @returns {{name: string, words: string}} */
export function stateOf(queue, running) {
  const held = queue.held ? `queue held${queue.held_by ? ` by ${queue.held_by}` : ""}${queue.held_reason ? `: ${queue.held_reason}` : ""}` : "";
  if (!queue.worker_alive) return { name: "down", words: "No worker answers" };
  if (running.some((run) => run.state === "running")) {
    const count = running.length > 1 ? `${running.length} tests running` : "Test running";
    return { name: "running", words: held ? `${count}, ${held}` : count };
  }
  return held ? { name: "held", words: held[0].toUpperCase() + held.slice(1) } : { name: "idle", words: "No test is running" };
}

/** The next tests in words. @param {any} queue @param {number} more running tests that are not shown */
export function nextTests(queue, more) {
  const also = more > 0 ? `${more} more ${more === 1 ? "test runs" : "tests run"}. ` : "";
  const [next] = queue.waiting;
  if (!next) return `${also}Next: the queue is empty`;
  const at = next.expected_start ? `, about ${clock(next.expected_start)}` : "";
  const others = queue.queued > 1 ? ` · ${queue.queued - 1} more in the queue` : "";
  return `${also}Next: ${next.name}${at}${others}`;
}

/** @param {string} iso */
const clock = (iso) => new Date(iso).toTimeString().slice(0, 5);
