"""The queue as people change it: by keyboard, by drag, held with a reason, with cancels that are undone; and what it tells."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from playwright.sync_api import Page, expect

from tests.browser.conftest import Opener
from tests.browser.service import Service
from tests.browser.test_pages import expect_accessible

SLOW = {"kind": "real_time", "factor": 0.1}


@pytest.fixture
def held(idle: Service) -> Iterator[Service]:
    """The service with the queue held, so that what is submitted waits."""
    idle.post("/queue/hold", {"by": "Bo", "reason": "oil leak"})
    yield idle


def names(page: Page) -> list[str]:
    return page.locator("#waiting-rows td.name a").all_inner_texts()


def test_the_queue_is_ordered_selected_and_released_on_its_page(held: Service, opened: Opener) -> None:
    for name in "ABCD":
        held.submit(name=name, duration=1.0)
    page = opened("/queue")
    expect(page.locator("#held")).to_contain_text("Reason: oil leak.")
    expect(page.locator("#waiting-rows tr")).to_have_count(4)
    assert names(page) == ["A", "B", "C", "D"]
    expect_accessible(page)

    rows = page.locator("#waiting-rows tr")
    up = rows.nth(2).get_by_role("button", name="up")
    up.focus()
    page.keyboard.press("Enter")
    expect(page.locator("#waiting-rows td.name a").nth(1)).to_have_text("C")
    expect(rows.nth(1).get_by_role("button", name="up")).to_be_focused()  # it moved with its test
    rows.nth(3).locator(".handle").drag_to(rows.nth(0), target_position={"x": 40, "y": 2})
    expect(page.locator("#waiting-rows td.name a").first).to_have_text("D")
    assert names(page) == ["D", "A", "C", "B"]

    for place in (1, 3):
        rows.nth(place).get_by_role("checkbox").check()
    expect(page.locator("#bulk-count")).to_have_text("2 tests selected")
    page.locator("#bulk-priority").select_option("2")
    expect(page.locator("#waiting-rows td.name a").first).to_have_text("A")
    assert names(page) == ["A", "B", "D", "C"]

    page.get_by_role("button", name="Cancel the tests").click()
    expect(rows).to_have_count(2)
    page.locator(".toast").get_by_role("button", name="Undo the cancel").click()
    expect(rows).to_have_count(4)
    assert names(page) == ["A", "B", "D", "C"]
    page.get_by_role("button", name="Release the queue").click()
    expect(page.locator("#waiting-none")).to_be_visible()
    started = [one["name"] for one in held.get("/events?kind=started&limit=4")["events"]]
    assert started[::-1] == ["A", "B", "D", "C"]


def test_rigs_and_webhooks_are_added_in_the_settings(service: Service, opened: Opener) -> None:
    page = opened("/settings", allow=("409",))
    rigs = page.locator("#rigs")
    rigs.get_by_label("Name").first.fill("Shaker")
    rigs.get_by_label("Stroke, ± mm").fill("150")
    rigs.get_by_role("button", name="Add the rig").click()
    expect(page.locator("#rig-rows tr")).to_have_count(2)
    expect(page.locator("#rig-rows tr").last).to_contain_text("physical, one test at a time")
    expect(page.locator("#rig-rows tr").last).to_contain_text("Actuator 1: 150 mm, –, –")
    assert page.locator("#rigs .scroll").evaluate("table => table.scrollWidth <= table.clientWidth"), "a row is cut"
    assert service.get("/rigs")["rigs"][1]["actuators"][0]["stroke"] == pytest.approx(0.15)
    hooks = page.locator("#webhooks")
    hooks.get_by_label("Address").fill("http://127.0.0.1:9/hook")
    hooks.get_by_role("button", name="Add the webhook").click()
    expect(page.locator("#webhook-secret")).to_contain_text("Keep it now")
    hooks.get_by_role("button", name="Send a test").click()
    hooks.get_by_text("Deliveries").click()
    expect(hooks.locator(".log li").first).to_contain_text("test")
    expect_accessible(page)
    hooks.get_by_role("button", name="Delete the webhook").click()
    expect(hooks.locator(".webhook")).to_have_count(0)
    page.get_by_role("button", name="Delete Shaker").click()
    expect(page.locator("#rig-rows tr")).to_have_count(1)


def test_a_running_test_is_cancelled_after_a_question_and_its_end_is_told(idle: Service, opened: Opener) -> None:
    run = idle.submit(name="Slow one", pace=SLOW, duration=30.0)
    idle.wait(run, "running")
    page = opened("/queue")
    page.get_by_role("button", name="Slow one").click()
    dialog = page.get_by_role("dialog")
    expect(dialog.get_by_role("button", name="Keep it running")).to_be_focused()
    expect_accessible(page)
    page.keyboard.press("Escape")
    assert idle.get(f"/runs/{run}")["state"] == "running"
    page.get_by_role("button", name="Slow one").click()
    dialog.get_by_role("button", name="Cancel the test").click()
    idle.wait(run, "cancelled")
    idle.completed(name="Quick one")
    expect(page.locator(".toast.good")).to_contain_text("Quick one: The test ran to its end.")
    bell = page.get_by_role("button", name="Events, 2 unread")
    bell.click()
    expect(page.locator("#bell-panel li").first).to_contain_text("Quick one")
    expect_accessible(page)
    page.keyboard.press("Escape")
    expect(page.get_by_role("button", name="Events", exact=True)).to_be_focused()
