"""Annotations on the charts of a run, its menu of downloads, and the form of a data set for DesignSafe."""

from __future__ import annotations

from playwright.sync_api import expect

from tests.browser.conftest import Opener
from tests.browser.service import Service
from tests.browser.test_pages import expect_accessible


def test_a_note_is_written_by_a_key_deleted_and_brought_back_and_a_data_set_says_what_it_lacks(
    service: Service, opened: Opener
) -> None:
    run = service.completed()
    page = opened(f"/runs/{run}")
    expect(page.get_by_text("No annotation yet.")).to_be_visible()
    page.locator("#name").click()
    page.keyboard.press("n")
    page.get_by_label("Time, s").fill("1.5")
    page.get_by_label("Note", exact=True).fill("The command saturates")
    page.get_by_label("Your name").fill("Ana Ruiz")
    page.get_by_role("button", name="Save the annotation").press("Enter")
    expect(page.locator(".note-line")).to_contain_text("The command saturates")
    assert service.get(f"/runs/{run}/annotations")["annotations"][0]["from_s"] == 1.5
    page.get_by_role("button", name="Delete annotation 1").click()
    expect(page.locator(".note-line")).to_have_count(0)
    page.get_by_role("button", name="Undo").click()
    expect(page.locator(".note-line")).to_have_count(1)
    menu = page.get_by_text("Download", exact=True)
    menu.press("Enter")
    expect(page.get_by_role("link", name="Report, PDF")).to_be_visible()
    page.keyboard.press("Escape")
    expect(page.get_by_role("link", name="Report, PDF")).to_be_hidden()
    expect_accessible(page)
    menu.click()
    page.get_by_role("link", name="Data set for DesignSafe").click()
    expect(page.locator("#complete")).to_contain_text("required entries are missing")
    page.get_by_label("Licence").select_option("Creative Commons Attribution")
    page.get_by_role("button", name="Check the data set").click()
    expect(page.locator('[data-wrong="project.title"]')).to_contain_text("is missing")
    expect(page.locator('[data-wrong="license"]')).to_be_empty()
    expect_accessible(page)
