"""The run table in a browser: search, order, columns, filters, keyboard, selection with undo, views and side panel."""

from __future__ import annotations

import pytest
from playwright.sync_api import Page, expect

from tests.browser.conftest import Opener, visit
from tests.browser.service import Service, until
from tests.browser.test_pages import expect_accessible

ALPHA = "plan.stations.0.compensator.alpha_es"


@pytest.fixture(scope="module")
def braces(service: Service) -> list[str]:
    plans = []
    for number in (1, 2, 3):
        plan = service.plan(name=f"Table brace {number}", duration=0.5)
        plan["stations"][0]["compensator"] = {"kind": "inverse", "alpha_es": 10.0 * number}
        plans.append(plan)
    runs = [run["id"] for run in service.post("/runs", {"plans": plans, "submitted_by": "Ana Ruiz"})["runs"]]
    for run in runs:
        service.wait(run, "completed")
    return runs


def names(page: Page) -> list[str]:
    return page.locator("#rows .at-name").all_inner_texts()


def expect_names(page: Page, *wanted: int) -> None:
    expect(page.locator("#rows .at-name")).to_have_text([f"Table brace {number}" for number in wanted])


def test_a_table_is_searched_sorted_filtered_and_its_columns_chosen_in_the_address(braces: list[str], opened: Opener) -> None:
    page = opened("/runs")
    page.locator("#rows tr").first.wait_for()
    page.keyboard.press("/")
    page.keyboard.type("table brace")
    expect_names(page, 3, 2, 1)
    page.get_by_role("button", name="Menu of column Name").click()
    page.keyboard.press("Enter")
    expect_names(page, 1, 2, 3)
    page.get_by_role("button", name="Choose columns").click()
    page.get_by_label("Search columns").fill("station 1 estimated delay")
    page.get_by_label("Estimated delay constant").first.check()
    page.get_by_role("button", name="Show columns").click()
    expect(page.locator("#heads")).to_contain_text("Estimated delay constant α_es")
    page.get_by_role("button", name="Menu of column Station 1: Delay compensator: Estimated").click()
    page.get_by_role("menuitem", name="Filter this column").click()
    page.get_by_label("Condition", exact=True).select_option(">=")
    page.get_by_label("Value").fill("20")
    page.get_by_role("button", name="Set filter").click()
    expect_names(page, 2, 3)
    expect(page.locator("#filters")).to_contain_text("α_es ≥ 20")
    address = page.url
    assert "sort=name" in address and "order=asc" in address and "alpha_es%3E%3D20" in address
    again = opened(address)
    expect_names(again, 2, 3)
    expect(again.locator("#rows tr").first).to_contain_text("20")
    again.get_by_role("button", name="Remove filter").click()
    expect_names(again, 1, 2, 3)
    again.locator(f'[data-sort="{ALPHA}"]').focus()
    again.keyboard.press("Shift+ArrowLeft")
    again.wait_for_url("**columns=**alpha_es%2Csubmitted_at**")
    expect(opened("/runs?state=cancelled&q=Table+brace").locator("#empty")).to_contain_text("No run matches this filter.")


def test_rows_are_selected_by_keyboard_tagged_deleted_and_restored(braces: list[str], service: Service, opened: Opener) -> None:
    page = opened("/runs?q=Table+brace")
    expect_names(page, 3, 2, 1)
    page.locator("#rows tr").first.focus()
    page.keyboard.press("Space")
    page.keyboard.press("Shift+ArrowDown")
    expect(page.locator("#selected")).to_have_text("2 runs selected")
    compared = page.get_by_role("link", name="Compare runs").get_attribute("href")
    assert compared == f"/compare?items=run:{braces[2]},run:{braces[1]}"
    page.get_by_role("button", name="Add tags").click()
    page.locator("#tags-input").fill("calibration, paper")
    page.get_by_role("button", name="Set tags").click()
    expect(page.locator("#rows .tag")).to_have_text(["calibration", "paper"] * 2)
    page.get_by_role("button", name="Delete runs").click()
    expect_names(page, 1)
    page.get_by_role("button", name="Undo").click()
    expect_names(page, 3, 2, 1)
    expect_accessible(page)


def test_the_panel_changes_name_and_notes_of_the_focused_run(braces: list[str], service: Service, opened: Opener) -> None:
    page = opened(f"/runs?q={'Table brace 1'.replace(' ', '+')}")
    panel = page.get_by_role("complementary", name="Focused run")
    expect(panel).to_contain_text("Peak force, kN")
    panel.get_by_label("Notes").fill("New oil.")
    panel.get_by_label("Name").fill("Table brace 1, reference")
    page.keyboard.press("Tab")
    expect(page.locator("#rows .at-name")).to_have_text("Table brace 1, reference")
    run = until(lambda: service.get(f"/runs/{braces[0]}"), lambda run: run["notes"] == "New oil.")
    assert run["name"] == "Table brace 1, reference" and run["plan"]["name"] == "Table brace 1"
    visit(page, f"/runs/{braces[0]}")
    expect(page.locator(".headline")).to_contain_text(f"#{run['number']}")
    expect(page.get_by_label("Notes")).to_have_value("New oil.")
    service.http.patch(f"/api/v1/runs/{braces[0]}", json={"name": "Table brace 1"})


def test_a_view_is_saved_opened_and_deleted(braces: list[str], opened: Opener) -> None:
    page = opened("/runs?q=Table+brace&sort=name&order=asc")
    page.get_by_role("button", name="Save view").click()
    page.get_by_label("Name of the view").fill("Braces")
    page.locator("#view-dialog").get_by_role("button", name="Save view").click()
    other = opened("/runs")
    other.get_by_label("View", exact=True).select_option("Braces")
    other.wait_for_url("**q=Table+brace**")
    expect_names(other, 1, 2, 3)
    other.get_by_role("button", name="Delete view").click()
    expect(other.get_by_label("View", exact=True)).to_have_value("q=Table+brace&sort=name&order=asc")
