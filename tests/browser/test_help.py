"""The help where one looks: terms under the pointer, the list behind "?", the documents and the search."""

from __future__ import annotations

import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import expect

from tests.browser.conftest import Opener
from tests.browser.service import Service


def test_a_label_is_explained_under_the_pointer_and_behind_the_question_mark(idle: Service, opened: Opener) -> None:
    page = opened(f"/runs/{idle.completed()}")
    page.locator("figcaption strong", has_text="Tracking indicator").first.hover()
    expect(page.locator("#term-note")).to_contain_text("TI, in mm²")
    page.keyboard.press("Escape")
    expect(page.locator("#term-note")).to_be_hidden()
    page.keyboard.press("?")
    dialog = page.get_by_role("dialog", name="Help on this page")
    expect(dialog).to_contain_text("move the cursor")
    expect(dialog.locator(".terms")).to_contain_text("maximum tracking error")
    assert Axe().run(page).violations_count == 0
    dialog.get_by_role("button", name="Close the help").press("Enter")
    expect(dialog).to_have_count(0)


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_the_help_is_searched_and_read_without_a_pointer(opened: Opener, scheme: str) -> None:
    page = opened("/help", color_scheme=scheme)
    expect(page.locator("#shortcuts")).to_contain_text("queue the test")
    assert Axe().run(page).violations_count == 0
    page.get_by_label("Search the help").fill("delay margin")
    page.keyboard.press("Enter")
    first = page.locator(".found a").first
    expect(first).to_be_visible()
    assert Axe().run(page).violations_count == 0
    first.press("Enter")
    page.wait_for_url("**/help/**.md*")
    expect(page.locator(".document h1")).to_be_visible()
    assert Axe().run(page).violations_count == 0
