// @ts-check
import { ApiError, api } from "../api.js";
import { loading } from "../ready.js";
import { planProblems } from "./bounds.js";

const QUIET_MS = 400;

/**
 * Check the plan with the service shortly after the last change. Answers to older checks are ignored.
 * @param {() => any} read @param {(checked: any | null, problems: any[]) => void} tell @param {(error: unknown) => void} failed
 */
export function liveCheck(read, tell, failed) {
  let timer = 0;
  let asking = new AbortController();

  const ask = async () => {
    asking.abort();
    const mine = (asking = new AbortController());
    try {
      const checked = await api.post("/plans/check", read(), mine.signal);
      tell(checked, []);
    } catch (error) {
      if (mine.signal.aborted) return;
      if (error instanceof ApiError && error.status === 422) tell(null, planProblems(error));
      else failed(error);
    }
  };
  return {
    soon() {
      clearTimeout(timer);
      timer = setTimeout(ask, QUIET_MS);
    },
    now: () => loading(ask()),
  };
}
