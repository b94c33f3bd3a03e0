// @ts-check
// The role of the person in front of the page. What a role may not do is hidden by css/roles.css: a control says in `data-needs` which
// role it needs. Scripts ask `may` only where there is no control to hide: keys, and what a page sends by itself.

const ROLES = ["viewer", "operator", "engineer", "administrator"];

/** Whether the person may do what needs this role. @param {string} needed */
export const may = (needed) => ROLES.indexOf(document.documentElement.dataset.role ?? "administrator") >= ROLES.indexOf(needed);
