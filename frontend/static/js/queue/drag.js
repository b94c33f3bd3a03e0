// @ts-check
// Dragging rows of a table to another place. A row is dragged by its handle; a line shows where it would go.

/**
 * @param {any} body the tbody @param {{begin: (id: string) => void, end: () => void, drop: (place: {before?: string, after?: string}) => void}} told
 */
export function draggable(body, told) {
  /** @type {any} */
  let over = null;
  let after = false;
  const clear = () => {
    over?.classList.remove("drop-before", "drop-after");
    over = null;
  };
  body.addEventListener("pointerdown", (/** @type {any} */ event) => {
    const row = event.target.closest("tr");
    if (row) row.draggable = Boolean(event.target.closest(".handle"));
  });
  body.addEventListener("dragstart", (/** @type {any} */ event) => {
    const row = event.target.closest("tr");
    event.dataTransfer.effectAllowed = "move";
    event.dataTransfer.setData("text/plain", row.id);
    told.begin(row.id.replace("waiting-", ""));
  });
  body.addEventListener("dragover", (/** @type {any} */ event) => {
    const row = event.target.closest("tr");
    if (!row) return;
    event.preventDefault();
    clear();
    const box = row.getBoundingClientRect();
    [over, after] = [row, event.clientY > box.top + box.height / 2];
    row.classList.add(after ? "drop-after" : "drop-before");
  });
  body.addEventListener("drop", (/** @type {any} */ event) => {
    event.preventDefault();
    const id = over?.id.replace("waiting-", "");
    if (id) told.drop(after ? { after: id } : { before: id });
  });
  body.addEventListener("dragend", (/** @type {any} */ event) => {
    clear();
    event.target.draggable = false;
    told.end();
  });
}
