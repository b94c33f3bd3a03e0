"""What is typed into the form is kept: in a closed tab, in two windows, without the service; and plans are saved."""

from __future__ import annotations

import re

import pytest
from playwright.sync_api import Page, expect

from tests.browser.checks import unfold
from tests.browser.conftest import Opener, loaded, visit
from tests.browser.service import Service, until
from tests.browser.test_pages import expect_accessible

ALPHA, WRONG = "Delay constant α", "0.2"
SAVED = re.compile(r"Draft saved \d\d:\d\d:\d\d")


@pytest.fixture
def form(idle: Service, opened: Opener) -> Page:
    """A form of someone whom no other test knows."""
    who = f"Mina {len(idle.get('/library/drafts')['drafts'])}"
    page = opened("/new?template=two-storeys", allow=("422", "409", "ERR_FAILED"), who=who)
    return ready(page)


def ready(page: Page) -> Page:
    expect(page.locator("#verdict > p").first).to_be_visible()
    unfold(page)
    return page


def test_an_invalid_plan_survives_a_closed_tab_and_is_found_again(form: Page, idle: Service) -> None:
    form.get_by_label(ALPHA, exact=True).first.fill(WRONG)
    form.get_by_label("Name", exact=True).first.fill("Half typed")
    form.once("dialog", lambda asked: asked.accept())
    with form.expect_event("close"):
        form.close(run_before_unload=True)  # within the 0.8 s before it would be saved
    until(lambda: [one["name"] for one in idle.get("/library/drafts")["drafts"]], lambda names: "Half typed" in names)
    again = form.context.new_page()
    visit(again, "/new")
    expect(again.get_by_text("You left a draft from template two-storeys")).to_be_visible()
    expect_accessible(again)
    again.get_by_role("link", name="Open the draft Half typed").click()
    expect(again.get_by_label(ALPHA, exact=True).first).to_have_value(WRONG)
    expect(again.locator("[id='e-stations.0.actuator.alpha']")).to_contain_text("needs")
    (draft,) = [one for one in idle.get("/library/drafts")["drafts"] if one["name"] == "Half typed"]
    assert "stations.0.actuator.alpha" in {one["where"] for one in draft["problems"]}


def test_two_windows_never_overwrite_each_other(form: Page) -> None:
    form.get_by_label("Notes").fill("of the first window")
    expect(form.locator("#draft")).to_contain_text(SAVED)
    second = form.context.new_page()
    visit(second, form.url)
    expect(second.get_by_label("Notes")).to_have_value("of the first window")
    with second.expect_response(lambda answer: "/library/drafts/" in answer.url and answer.request.method == "PUT") as saved:
        second.get_by_label("Notes").fill("of the second window")
    assert saved.value.ok  # the words of the restored draft say "saved" before
    form.get_by_label("Notes").fill("again of the first")
    expect(form.locator("#draft")).to_contain_text("Not saved: Another window saved this draft at")
    expect_accessible(form)
    form.get_by_role("button", name="Save mine as a new draft").click()
    expect(form.locator("#draft")).to_contain_text(SAVED)
    assert form.url != second.url
    second.reload()
    loaded(second)
    expect(second.get_by_label("Notes")).to_have_value("of the second window")


def test_edits_are_held_by_the_browser_while_the_service_is_away(form: Page) -> None:
    form.route("**/library/drafts/*", lambda route: route.abort())
    form.get_by_label("Notes").fill("typed without a service")
    expect(form.locator("#draft")).to_contain_text("Not saved: The service does not answer.")
    form.unroute_all()
    again = form.context.new_page()
    visit(again, "/new")
    again.get_by_role("link", name="Open the draft").click()
    expect(again.get_by_label("Notes")).to_have_value("typed without a service")
    expect(again.locator("#draft")).to_contain_text(SAVED)


def test_a_discarded_draft_is_restored(form: Page) -> None:
    form.get_by_label("Duration, s").fill("7")
    form.get_by_role("button", name="Discard the draft").click()
    expect(form.get_by_label("Duration, s")).to_have_value("40")
    form.get_by_role("button", name="Restore the draft").click()
    expect(form.get_by_label("Duration, s")).to_have_value("7")


def test_a_plan_is_saved_to_the_library_changed_and_queued_from_it(form: Page, idle: Service) -> None:
    form.get_by_label("Duration, s").fill("3")
    form.get_by_role("button", name="Save to the library").click()
    dialog = form.get_by_role("dialog", name="Save to the library")
    dialog.get_by_label("Name in the library").fill("Kept by a browser")
    expect_accessible(form)
    form.keyboard.press("Enter")
    expect(form.locator("#draft")).to_have_text("Saved as version 1 of Kept by a browser")
    form.get_by_label("Duration, s").fill("2")
    expect(form.locator("#draft")).to_contain_text(SAVED)
    form.get_by_role("button", name="Save to the library").click()
    dialog.get_by_label("Comment: what changed").fill("Shorter")
    dialog.get_by_role("button", name="Save the plan").click()
    expect(form.locator("#draft")).to_have_text("Saved as version 2 of Kept by a browser")
    form.get_by_role("button", name="Queue the test").click()
    form.wait_for_url("**/runs/*")
    run = idle.get(f"/runs/{form.url.rpartition('/')[2]}")
    kept = idle.get(f"/library/plans/{run['library_id']}")
    assert (run["library_version"], kept["name"], kept["newest"]["comment"]) == (2, "Kept by a browser", "Shorter")
    assert until(lambda: idle.get(f"/library/drafts?origin={kept['id']}")["drafts"], lambda drafts: not drafts) == []
