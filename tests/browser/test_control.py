"""The control of a rig and approvals on the page Queue, by the keyboard, as two people see them."""

from __future__ import annotations

import re
import threading
from collections.abc import Callable, Iterator
from typing import Any

import httpx
import pytest
import uvicorn
from playwright.sync_api import Page, ViewportSize, expect

from app.config import Settings
from app.main import create_app
from tests.app.conftest import plan
from tests.browser.conftest import visit
from tests.browser.contexts import Contexts
from tests.browser.service import free_port, until
from tests.browser.test_pages import expect_accessible

NARROW: ViewportSize = {"width": 390, "height": 800}
WIDE: ViewportSize = {"width": 1400, "height": 900}
RULES = {"one_driver": False, "approvals": False, "approvers": []}


@pytest.fixture(scope="module")
def lab(tmp_path_factory: pytest.TempPathFactory) -> Iterator[httpx.Client]:
    """A control room without accounts and without a worker, where people give their names."""
    data, port = tmp_path_factory.mktemp("control"), free_port()
    app = create_app(Settings(data=data, port=port, embedded_worker=False, local_sign_in=True))
    server = uvicorn.Server(uvicorn.Config(app, port=port, log_level="error", timeout_graceful_shutdown=1))
    thread = threading.Thread(target=server.run)
    thread.start()
    until(lambda: server.started, bool)
    with httpx.Client(base_url=f"http://127.0.0.1:{port}/api/v1/", timeout=60) as client:
        yield client
    server.should_exit = True
    thread.join(30)


@pytest.fixture
def rules(lab: httpx.Client) -> Iterator[Callable[..., Any]]:
    """Switch rules of the laboratory on; all are off again after the test."""
    yield lambda **on: lab.put("rules", json=RULES | on).raise_for_status()
    lab.put("rules", json=RULES).raise_for_status()


@pytest.fixture
def queue_of(contexts: Contexts, lab: httpx.Client) -> Iterator[Callable[..., Page]]:
    """The page Queue of a person."""
    url = str(lab.base_url).removesuffix("/api/v1/")
    with contexts.taken() as take:

        def opened(name: str, viewport: ViewportSize = WIDE, **options: Any) -> Page:
            page = take(url, name, viewport=viewport, reduced_motion="reduce", **options).new_page()
            visit(page, "/queue")
            return page

        yield opened


def press(page: Page, name: str) -> None:
    """Press a button by the keyboard."""
    page.get_by_role("button", name=name).press("Enter")


def whole(page: Page) -> None:
    expect_accessible(page)
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth"), f"{page.url} scrolls sideways"


def test_the_control_is_taken_asked_for_handed_over_and_given_up(
    rules: Callable[..., Any], queue_of: Callable[..., Page]
) -> None:
    rules(one_driver=True)
    ana = queue_of("Ana Ruiz")
    line = ana.locator("#control")
    expect(line).to_contain_text("Nobody drives Emulated laboratory.")
    press(ana, "Take the control")
    expect(line).to_contain_text("You drive Emulated laboratory until")
    expect(line.get_by_role("button", name="Give up the control")).to_be_focused()
    bo = queue_of("Bo Lind", NARROW, color_scheme="dark")
    hold = bo.get_by_role("button", name="Hold the queue")
    expect(hold).to_be_disabled()
    expect(hold).to_have_attribute("title", re.compile("Ana Ruiz drives Emulated laboratory until"))
    expect(ana.get_by_role("button", name="Hold the queue")).to_be_enabled()
    press(bo, "Ask for the control")
    expect(bo.locator("#control")).to_contain_text("Ana Ruiz sees that you ask.")
    whole(bo)
    visit(ana, "/queue")
    expect(line).to_contain_text("Bo Lind asks for the control.")
    whole(ana)
    press(ana, "Hand over to Bo Lind")
    expect(line).to_contain_text("Bo Lind drives Emulated laboratory until")
    visit(bo, "/queue")
    press(bo, "Give up the control")
    expect(bo.locator("#control")).to_contain_text("Nobody drives Emulated laboratory.")


def test_the_new_test_page_says_who_drives_and_how_to_get_the_control_before_the_press(
    lab: httpx.Client, rules: Callable[..., Any], queue_of: Callable[..., Page]
) -> None:
    rules(one_driver=True)
    (rig,) = lab.get("control").json()["rigs"]
    lab.post(f"control/{rig['rig_id']}/take", json={"by": "Ana Ruiz"}).raise_for_status()
    bo = queue_of("Bo Lind", NARROW, color_scheme="dark")
    visit(bo, "/new")
    submit = bo.get_by_role("button", name="Queue the test")
    expect(submit).to_be_disabled()
    expect(submit).to_have_attribute("title", re.compile("Ana Ruiz drives Emulated laboratory. Only the driver"))
    expect(submit).to_have_accessible_description(re.compile("Ana Ruiz drives Emulated laboratory until"))
    whole(bo)
    press(bo, "Ask for the control")
    expect(bo.locator("#control")).to_contain_text("Ana Ruiz sees that you ask.")
    bo.keyboard.press("Control+Enter")  # as little as the button
    lab.post(f"control/{rig['rig_id']}/hand-over", json={"by": "Ana Ruiz", "to": "Bo Lind"}).raise_for_status()
    visit(bo, "/new")
    expect(bo.locator("#control")).to_contain_text("You drive Emulated laboratory until")
    expect(submit).to_be_enabled()
    assert lab.get("runs", params={"limit": 1}).json()["total"] == 0
    press(bo, "Give up the control")
    expect(submit).to_be_disabled()
    expect(bo.locator("#control")).to_contain_text("Nobody drives Emulated laboratory.")


def test_submissions_are_approved_rejected_and_withdrawn(
    lab: httpx.Client, rules: Callable[..., Any], queue_of: Callable[..., Page]
) -> None:
    rules(approvals=True)
    runs = []
    for name in ("Brace", "Damper", "Frame"):
        body = {"plan": plan(name=name), "submitted_by": "Ana Ruiz"}
        runs.append(lab.post("runs", json=body).raise_for_status().json()["runs"][0])
    bo = queue_of("Bo Lind")
    waits = bo.locator("#approvals-list li")
    expect(waits).to_have_count(3)
    expect(waits.first).to_contain_text("2 s, as fast as possible. Submitted by Ana Ruiz")
    whole(bo)
    press(bo, f"Approve Run {runs[0]['number']}, Brace")
    expect(waits).to_have_count(2)
    expect(waits.first.get_by_role("button", name="Approve")).to_be_focused()
    expect(bo.locator("#waiting-rows")).to_contain_text("Brace")
    press(bo, f"Reject Run {runs[1]['number']}, Damper")
    expect(bo.get_by_label("Reason, which the submitter reads")).to_be_focused()
    whole(bo)
    bo.keyboard.type("too fast\n")
    expect(waits).to_have_count(1)
    assert lab.get(f"runs/{runs[1]['id']}").json()["reason"] == "Rejected by Bo Lind: too fast"
    ana = queue_of("Ana Ruiz", NARROW, color_scheme="dark")
    own = ana.locator("#approvals-list li")
    expect(own).to_contain_text("You cannot approve or reject your own submission: withdraw it instead.")
    expect(own.get_by_role("button", name="Approve")).to_have_count(0)
    whole(ana)
    press(ana, f"Withdraw Run {runs[2]['number']}, Frame")
    expect(ana.locator("#approvals")).to_be_hidden()
    expect(ana.locator("#undo-list")).to_contain_text("Frame")
    expect(ana.locator("#undo-list")).not_to_contain_text("Damper")  # it was rejected: there is nothing to undo
