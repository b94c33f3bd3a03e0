"""The library of plans in the browser: found, archived and brought back, compared, queued with its preflight."""

from __future__ import annotations

import re

import pytest
from playwright.sync_api import Page, expect

from tests.browser.conftest import Opener, visit
from tests.browser.service import Service
from tests.browser.test_pages import expect_accessible

TRIPS = {
    "verdict": "trips",
    "sentence": "Would trip at 1.50 s: station 1, command velocity 304 > 300 mm/s",
    "uses": [
        {"name": "Storey 1 damper", "label": "command velocity", "against": "limit", "against_label": "safety limit"}
        | {"peak": 0.304, "bound": 0.3, "share": 1.0133, "shown_label": "mm/s", "factor": 1e-3}
    ],
    "notes": [],
}
NAME = "Frame with a slower valve"


@pytest.fixture(scope="module")
def kept(service: Service) -> str:
    """A plan of two versions and a draft of it that is not valid."""
    first = {"plan": service.plan(duration=2.0), "name": NAME, "tags": ["valve"], "comment": "As calibrated"}
    kept: str = service.post("/library/plans", first)["id"]
    service.post(f"/library/plans/{kept}/versions", {"plan": service.plan(duration=3.0, seed=9), "comment": "Longer"})
    draft = {"plan": {**service.plan(), "name": "Typed", "duration": "4o s"}, "revision": 0, "owner": "Lena"}
    origin = {"kind": "version", "id": kept, "version": 2}
    service.http.put("/api/v1/library/drafts/lena", json={**draft, "origin": origin}).raise_for_status()
    return kept


@pytest.fixture
def plans(kept: str, idle: Service, opened: Opener) -> Page:
    page = opened("/plans", who="Lena", allow=("422",))
    expect(page.get_by_role("row", name=NAME).last).to_be_visible()
    return page


def test_a_person_finds_own_drafts_with_what_is_wrong_and_restores_a_discarded_one(plans: Page) -> None:
    drafts = plans.get_by_role("region", name="Table of your drafts")
    expect(drafts).to_contain_text(f"{NAME}, version 2")
    expect(drafts).to_contain_text("Duration = 4o s: needs a unit of time")
    plans.get_by_role("button", name="Discard the draft Typed").click()
    expect(plans.locator("#drafts")).to_contain_text("You have no draft.")
    plans.get_by_role("button", name="Undo").click()
    expect(drafts).to_contain_text("Typed")


def test_plans_are_found_by_text_and_tag_archived_and_brought_back(plans: Page) -> None:
    row = plans.get_by_role("region", name="Plans in the library").get_by_role("row", name=NAME)
    plans.get_by_label("Text").fill("no such plan")
    expect(plans.get_by_text("No plan matches this filter.")).to_be_visible()
    plans.get_by_label("Text").fill("longer")
    expect(row).to_contain_text("Version 2: Longer")
    plans.wait_for_url("**/plans?q=longer")
    plans.get_by_role("button", name="Show plans with the tag valve").click()
    plans.wait_for_url("**/plans?q=longer&tag=valve")
    plans.get_by_role("button", name=f"Archive {NAME}").click()
    expect(plans.locator("#notice")).to_contain_text(f"{NAME} archived.")
    expect(row).to_have_count(0)
    plans.get_by_label("Archived plans").check()
    expect(row).to_be_visible()
    plans.get_by_role("button", name="Undo").click()
    plans.get_by_label("Archived plans").uncheck()
    expect(row).to_be_visible()


def test_two_versions_are_compared_and_one_is_queued_with_its_preflight(kept: str, plans: Page, idle: Service) -> None:
    plans.get_by_role("region", name="Plans in the library").get_by_role("link", name=NAME, exact=True).click()
    plans.get_by_role("button", name="Compare versions 1 and 2").click()
    rows = plans.get_by_role("region", name="Differences between the plans").locator("tbody tr")
    expect(rows).to_have_text([re.compile(r"Seed.*4.*9"), re.compile("Duration.*2.*3.*s")])
    plans.route("**/plans/preflight", lambda route: route.fulfill(json=TRIPS))  # its own test is test_preflight's
    plans.get_by_role("button", name="Queue version 2").click()
    dialog = plans.get_by_role("dialog")
    expect(dialog).to_contain_text("Storey 1 damper: command velocity304 of 300 mm/s (100 %)")
    expect_accessible(plans)
    dialog.get_by_role("button", name="Queue the test although it would trip").click()
    plans.wait_for_url("**/runs/*")
    run = idle.wait(plans.url.rpartition("/")[2], "completed", "tripped")
    assert (run["library_id"], run["library_version"], run["submitted_by"]) == (kept, 2, "Lena")
    plans.go_back()
    expect(plans.get_by_role("region", name="Table of the runs")).to_contain_text("The test ran to its end.")


def test_a_plan_is_renamed_tagged_and_opened_in_the_form(kept: str, plans: Page) -> None:
    visit(plans, f"/plans/{kept}")
    plans.get_by_text("Rename or tag the plan").click()
    plans.get_by_label("Tags, separated by commas").fill("valve, spring 2027")
    plans.get_by_role("button", name="Save name and tags").click()
    expect(plans.get_by_role("link", name="spring 2027")).to_be_visible()
    plans.get_by_role("link", name="Open version 1 in the form").click()
    expect(plans.get_by_label("Duration, s")).to_have_value("2")
