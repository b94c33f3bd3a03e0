// @ts-check
// On a narrow window the pages of the menu stand in a row that scrolls: the present one is brought into view.

const present = document.querySelector(".top nav [aria-current]");
const row = present?.parentElement;
if (row && present instanceof HTMLElement) row.scrollLeft = present.offsetLeft - row.offsetLeft - (row.clientWidth - present.offsetWidth) / 2;
