// @ts-check
import { byId } from "../dom.js";

const [FEWEST, MOST] = [2, 20];
const form = byId("choose");

/** Say how many items are chosen, and offer the comparison when their number is right. */
function count() {
  const chosen = form.querySelectorAll("input[name=items]:checked").length;
  const right = chosen >= FEWEST && chosen <= MOST;
  const button = form.querySelector("button:not([name])");
  if (!button) return;
  button.disabled = !right;
  byId("count").textContent = right ? `${chosen} items are chosen.` : `${chosen} ${chosen === 1 ? "item is" : "items are"} chosen; choose ${FEWEST} to ${MOST}.`;
}

form.addEventListener("change", count);
count();
