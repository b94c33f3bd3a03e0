"""One service and one browser for all browser tests; every page opened is watched for errors and foreign addresses."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable, Iterator
from typing import Any
from urllib.parse import urlsplit

import pytest
from playwright.sync_api import Browser, ConsoleMessage, Page, expect, sync_playwright

from tests.app.test_diagnoses import LEFT_OUT, OTHER, PATIENCE_S, ask, plan, until_state
from tests.browser.contexts import PATIENCE_MS, Contexts
from tests.browser.service import Service, running

ARGUMENTS = [
    "--headless=new",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
]
WIDE = {"width": 1360, "height": 900}

Opener = Callable[..., Page]

expect.set_options(timeout=PATIENCE_MS)


@pytest.fixture(scope="session")
def service(browser: Browser, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Service]:
    with running(tmp_path_factory.mktemp("service"), calculating=True) as one:
        one.warm_up()
        yield one


@pytest.fixture(scope="session")
def browser() -> Iterator[Browser]:
    path = shutil.which("chromium")
    if path is None:
        reason = "no chromium on the PATH: the pages are not tested (Debian: apt-get install chromium)"
        if os.environ.get("CI") == "true":
            pytest.fail(reason)
        pytest.skip(reason)
    with sync_playwright() as playwright:
        started = playwright.chromium.launch(executable_path=path, args=ARGUMENTS)
        yield started
        started.close()


@pytest.fixture(scope="session")
def contexts(browser: Browser) -> Contexts:
    return Contexts(browser)


@pytest.fixture
def idle(service: Service) -> Iterator[Service]:
    """The service with nothing queued or running, before and after."""
    service.idle()
    yield service
    service.idle()


@pytest.fixture(scope="session")
def played(service: Service) -> str:
    """A run whose specimen has play."""
    named = {**plan(specimen_physics=LEFT_OUT), "name": "Played damper"}
    run: str = service.post("/runs", {"plan": named})["runs"][0]["id"]
    service.wait(run, "completed", within_s=PATIENCE_S)
    return run


@pytest.fixture(scope="session")
def diagnosed(service: Service, played: str) -> str:
    """A completed diagnosis of that run, with a plan that leaves the play out and has another motion."""
    return str(until_state(service, ask(service, played, name="Played damper", plan={**plan(), **OTHER}), "completed")["id"])


class Watch:
    """What went wrong on a page: console errors, exceptions, failed requests, addresses beyond this machine."""

    def __init__(self, page: Page):
        self.faults: list[str] = []
        self.allowed: tuple[str, ...] = ()
        page.on("console", self._console)
        page.on("pageerror", lambda error: self.faults.append(f"exception: {error}"))
        page.on("requestfailed", lambda request: self._failed(request))
        page.on("request", lambda request: self._asked(request.url))
        page.on("websocket", lambda socket: self._asked(socket.url))

    def _console(self, message: ConsoleMessage) -> None:
        if message.type in {"error", "warning"}:
            self.faults.append(f"console: {message.text}")

    def _failed(self, request: Any) -> None:
        if "ERR_ABORTED" not in (request.failure or ""):  # a page that is left gives up its requests
            self.faults.append(f"failed: {request.url} {request.failure}")

    def _asked(self, url: str) -> None:
        parts = urlsplit(url)
        if parts.scheme not in {"blob", "data"} and parts.hostname != "127.0.0.1":
            self.faults.append(f"left this machine: {url}")

    def check(self) -> None:
        found = [fault for fault in self.faults if not any(text in fault for text in self.allowed)]
        assert found == []


def visit(page: Page, path: str) -> None:
    """Open an address and wait until the page has shown the data that it asks for first.

    After a click that leads to another page, too, no locator acts or is asserted before that page is loaded.
    """
    page.goto(path)
    loaded(page)


def loaded(page: Page) -> None:
    """Wait until the page is loaded: js/ready.js."""
    page.locator("html:not([data-loading])").wait_for(state="attached")


@pytest.fixture
def opened(contexts: Contexts, service: Service) -> Iterator[Opener]:
    """Open a page of the service; `allow` names faults that the test provokes."""
    watches = []
    with contexts.taken() as take:

        def open_page(path: str, allow: tuple[str, ...] = (), who: str = "Ana Ruiz", **options: Any) -> Page:
            page = take(service.url, who, **{"viewport": WIDE, "color_scheme": "light", **options}).new_page()
            watch = Watch(page)
            watch.allowed = allow
            watches.append(watch)
            visit(page, path)
            return page

        yield open_page
    for watch in watches:
        watch.check()
