// @ts-check
// While a page loads, <html> has the attribute `data-loading`: until its modules have run, and the data that they ask for first are
// shown. css/loading.css hides the parts whose place depends on those data, so that nothing moves under a pointer.

const root = document.documentElement;
let awaited = 0;

/** Work that the page waits for before it counts as loaded. @template T @param {Promise<T>} work @returns {Promise<T>} */
export async function loading(work) {
  if (!root.hasAttribute("data-loading")) return work;
  awaited += 1;
  try {
    return await work;
  } finally {
    awaited -= 1;
    look();
  }
}

/** What follows from an answer is shown, or asks for more, before the next task of the event loop. */
function look() {
  setTimeout(() => {
    if (!awaited && document.readyState === "complete") root.removeAttribute("data-loading");
  });
}

addEventListener("load", look);
