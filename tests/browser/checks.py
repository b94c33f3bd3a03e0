"""What the service answered to the form's live check."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from typing import Any

from playwright.sync_api import Error, Page, Route

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
