"""A diagnosis asked for on its page, watched, read, cancelled, and its extended plan laid over the recording."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from playwright.sync_api import expect

from tests.app.test_diagnoses import PATIENCE_S, ask, plan
from tests.browser.conftest import Opener
from tests.browser.service import Service
from tests.browser.test_pages import expect_accessible

DONE_MS = PATIENCE_S * 1000


def test_a_run_is_diagnosed_against_a_plan_file_and_the_result_read(
    service: Service, played: str, opened: Opener, tmp_path: Path
) -> None:
    path = tmp_path / "plan.yaml"
    path.write_text(service.http.post("/api/v1/plans/write", json=plan()).text, encoding="utf-8")
    page = opened(f"/runs/{played}")
    page.get_by_role("link", name="Diagnose this run").click()
    page.get_by_label("Plan to check").select_option("file")
    page.get_by_label("Plan file", exact=True).set_input_files(path)
    page.get_by_role("button", name="Diagnose the recording").click()
    page.wait_for_url("**/diagnoses/*-*")
    expect(page.locator(".verdict")).to_contain_text("backlash was left out", timeout=DONE_MS)
    expect(page.get_by_text("by Ana Ruiz")).to_be_visible()
    components = page.get_by_role("region", name="Components", exact=True)
    expect(components.locator("tr", has_text="Specimen of Station")).to_contain_text("mismatch")
    ranking = page.get_by_role("region", name="Ranking of the candidates").locator("tbody tr")
    expect(ranking.first).to_contain_text("Backlash (specimen of Station)")
    parameters = page.get_by_role("region", name="Parameters of the left-out physics").locator("tbody tr")
    expect(parameters).to_have_count(1)
    expect(parameters).to_contain_text("mm")
    for plot in ("Residual of each component over time", "Force: recording and simulation", "Residual of the force",
                 "Spectrum of the residual of the force", "Force against displacement", "Residual against velocity",
                 "Error of each block"):  # fmt: skip
        expect(page.get_by_role("img", name=plot).locator("svg.main-svg").first).to_be_attached()
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth"), "the page scrolls sideways"


def test_progress_is_shown_and_a_cancel_leaves_only_the_word(service: Service, played: str, opened: Opener) -> None:
    ahead = [ask(service, played) for _ in range(2)]  # so that the third waits while the page is looked at
    page = opened(f"/diagnoses/{ask(service, played)}")
    expect(page.get_by_role("progressbar")).to_be_visible()
    expect(page.get_by_role("status").filter(has_text="Waiting in the queue")).to_be_visible()
    expect_accessible(page)
    page.get_by_role("button", name="Cancel this diagnosis").click()
    expect(page.get_by_text("Cancelled by Ana Ruiz before it started.")).to_be_visible()
    expect(page.locator(".verdict")).to_have_count(0)
    for one in ahead:
        service.http.post(f"/api/v1/diagnoses/{one}/cancel", json={})
    page.on("dialog", lambda dialog: dialog.accept())
    page.get_by_role("button", name="Delete this diagnosis").click()
    page.wait_for_url("**/diagnoses")


def test_the_extended_plan_is_queued_by_keyboard_and_laid_over_the_recording(
    service: Service, diagnosed: str, opened: Opener
) -> None:
    page = opened(f"/diagnoses/{diagnosed}")
    button = page.get_by_role("button", name="Queue the extended plan")
    button.focus()
    page.keyboard.press("Enter")
    expect(page.locator("#simulations").get_by_role("link", name="Untitled test, after diagnosis")).to_be_visible()
    force = page.get_by_role("img", name="Force of station 1: recording")
    expect(force.locator("svg.main-svg").first).to_be_attached(timeout=DONE_MS)
    expect(page.get_by_role("img", name="Displacement of station 1: recording")).to_be_attached()
    expect(button).to_have_count(0)
    expect_accessible(page)


def test_a_form_without_recording_or_plan_says_so(service: Service, played: str, opened: Opener) -> None:
    page = opened("/diagnoses", allow=("422",))
    page.get_by_role("button", name="Diagnose the recording").click()
    expect(page.get_by_role("alert")).to_have_text("Select a recording.")
    page.get_by_label("Recording", exact=True).select_option(f"run:{played}")
    page.get_by_label("Plan to check").select_option("file")
    page.get_by_role("button", name="Diagnose the recording").click()
    expect(page.get_by_role("alert")).to_have_text("Select a plan file, or select another plan.")
    page.get_by_label("Plan to check").select_option("template:two-storeys")
    page.get_by_role("button", name="Diagnose the recording").click()
    expect(page.get_by_role("alert")).to_contain_text("the plan describes a 'hybrid' test")


def test_a_linear_plan_is_chosen_by_keyboard_and_the_results_are_read_on_a_narrow_screen(
    service: Service, played: str, diagnosed: str, opened: Opener
) -> None:
    page = opened(f"/diagnoses?run={played}", viewport={"width": 390, "height": 800})
    row = page.locator("tr", has=page.locator(f'a[href="/diagnoses/{diagnosed}"]'))
    box = row.locator("td.sentence").bounding_box()
    assert box is not None and box["x"] + box["width"] <= 390, "the result begins or ends outside the screen"
    page.get_by_label("Plan to check").focus()
    page.keyboard.type("Linear")
    page.get_by_role("button", name="Diagnose the recording").press("Enter")
    page.wait_for_url("**/diagnoses/*-*")
    expect(page.get_by_text("Linear model fitted to Played damper")).to_be_visible()
    expect_accessible(page)
    service.http.post(f"/api/v1{page.url.removeprefix(service.url)}/cancel", json={})


def test_the_report_is_drawn_without_a_service(diagnosed: str, opened: Opener, service: Service, tmp_path: Path) -> None:
    path = tmp_path / "report.html"
    path.write_text(service.http.get(f"/api/v1/diagnoses/{diagnosed}/report.html?interactive=true").text, encoding="utf-8")
    context: Any = opened("/table4").context
    page = context.new_page()
    page.goto(path.as_uri())
    expect(page.locator(".verdict")).to_contain_text("backlash was left out")
    expect(page.locator(".plot svg.main-svg").first).to_be_attached()
    expect_accessible(page)


def test_an_unknown_diagnosis_says_so(opened: Opener) -> None:
    page = opened("/diagnoses/not-a-diagnosis", allow=("404",))
    expect(page.get_by_text("There is no diagnosis not-a-diagnosis.")).to_be_visible()
