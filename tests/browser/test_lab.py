"""The Lab page in a browser: the tour stays hidden, and a card shows a running test."""

from __future__ import annotations

from playwright.sync_api import expect

from tests.browser.conftest import Opener, loaded
from tests.browser.service import Service


def test_a_running_test_has_a_card_and_the_tour_stays_hidden(idle: Service, opened: Opener) -> None:
    run = idle.submit(name="Watched", duration=40.0, pace={"kind": "real_time", "factor": 1.0})
    page = opened("/")
    card = page.locator(f"#running-{run}")
    expect(card.locator(".card-margin")).to_contain_text("% of the limit on")
    expect(card.locator(".card-curve svg")).to_have_count(2)
    page.get_by_role("button", name="Hide the tour").click()
    expect(page.locator("#tour")).to_be_hidden()
    page.reload()
    loaded(page)
    expect(page.locator("#tour")).to_be_hidden()
    page.get_by_role("button", name="Show the tour").press("Enter")
    expect(page.locator("#tour")).to_be_visible()


def test_the_page_tells_what_happened_since_the_last_visit(idle: Service, opened: Opener) -> None:
    page = opened("/")
    idle.completed(name="Meanwhile")
    page.add_init_script("localStorage.setItem('rths.seen', new Date(Date.now() - 3600e3).toISOString())")
    page.reload()
    loaded(page)
    expect(page.locator("#since")).to_contain_text("Since you were last here, 1 h")
    expect(page.locator("#since .news")).to_contain_text("Meanwhile")
