"""The form in tests: what the service answered to its live check, its templates and its folded stations."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from typing import Any

from playwright.sync_api import Error, Page, Route, expect

ADDRESS = "**/plans/check"
PATIENCE_MS, POLL_MS = 20_000, 50


def checked(
    form: Page, change: Callable[[], Any], wanted: Callable[[dict[str, Any]], bool] = lambda plan: True
) -> dict[str, Any]:
    """The answer to the check that follows `change` and whose plan is `wanted`.

    The form drops a check when the next begins, and the browser forgets the answer; it is kept on its way here.
    """
    answers: list[dict[str, Any]] = []

    def keep(route: Route) -> None:
        with suppress(Error):  # dropped by the form meanwhile
            response = route.fetch()
            answers.append(response.json())
            route.fulfill(response=response)

    form.route(ADDRESS, keep)
    try:
        change()
        for _ in range(PATIENCE_MS // POLL_MS):
            for answer in reversed(answers):
                if "plan" in answer and wanted(answer["plan"]):
                    found: dict[str, Any] = answer
                    return found
            form.wait_for_timeout(POLL_MS)
        raise AssertionError(f"no check of the wanted plan was answered: {answers}")
    finally:
        form.unroute_all(behavior="ignoreErrors")


def choose(form: Page, template: str) -> None:
    """Choose a template in the picker, let an edited plan go, wait until the template is in the form, and open its folds."""
    form.get_by_role("button", name="Start from a template").click()
    form.locator(f"[data-template='{template}']").click()
    agree = form.get_by_role("button", name="Replace the plan")
    filled = form.locator(f"[data-template='{template}'][aria-current]")
    expect(agree.or_(filled)).to_have_count(1)
    if agree.count():
        agree.click()
    expect(filled).to_have_count(1)
    expect(form.locator(".good")).to_be_visible()
    unfold(form)


def unfold(form: Page) -> None:
    """Open the folds of all stations."""
    form.evaluate("for (const fold of document.querySelectorAll('details.fold')) fold.open = true")
