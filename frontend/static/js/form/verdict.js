// @ts-check
import { el } from "../dom.js";
import { problemList, summaryOf } from "./summary.js";

/** @typedef {import("./plan_form.js").PlanForm} PlanForm @typedef {import("./plan_form.js").Problem} Problem */

/** The verdict of the check in the bar, and what it found beside the form. */
export class Verdict {
  /** @param {HTMLElement} bar @param {HTMLElement} findings @param {() => PlanForm} form */
  constructor(bar, findings, form) {
    this.bar = bar;
    this.findings = findings;
    this.form = form;
    /** @type {{template: string | null, digest: string | null}} the template that filled the form, and its digest */
    this.origin = { template: null, digest: null };
  }

  /** The form was filled anew. @param {string | null} template */
  begin(template) {
    this.origin = { template, digest: null };
  }

  /** Show the answer to a check. Returns all problems. @param {any | null} checked @param {Problem[]} refused @returns {Problem[]} */
  show(checked, refused) {
    const form = this.form();
    const own = form.problems();
    const paths = new Set(own.map((problem) => problem.where));
    const problems = [...own, ...refused.filter((problem) => !paths.has(problem.where))];
    form.mark(problems);
    if (problems.length) {
      this.#say("error", problems.length === 1 ? "1 error" : `${problems.length} errors`);
      this.findings.replaceChildren(el("h3", {}, "Errors"), problemList(problems, (where) => form.control(where)));
    } else if (checked) {
      const note = this.#difference(checked.digest);
      this.#say("good", "The plan is valid");
      this.findings.replaceChildren(...summaryOf(checked), note ?? "");
    }
    return problems;
  }

  /** @param {string} words */
  complain(words) {
    this.#say("error", words);
  }

  /** @param {string} kind @param {string} words */
  #say(kind, words) {
    const shown = this.bar.firstElementChild;
    if (shown?.className === kind && shown.textContent === words) return; // said once, not after each key
    this.bar.replaceChildren(el("p", { class: kind }, words));
  }

  /** @param {string} digest */
  #difference(digest) {
    const { origin } = this;
    origin.digest ??= digest;
    const changed = origin.template && origin.digest !== digest;
    this.form().kept.template = changed ? null : origin.template;
    const paper = origin.template?.startsWith("table3-") ? " The result cannot be compared with the paper." : "";
    return changed ? el("p", { class: "muted" }, `The plan differs from the template ${origin.template}.${paper}`) : null;
  }
}
