"""The form before the queue: few tab stops, a dry run beside the fields, and nothing queued, overwritten or left unasked."""

from __future__ import annotations

from playwright.sync_api import Page, Route, expect

from tests.browser.checks import choose, unfold
from tests.browser.conftest import Opener
from tests.browser.service import Service
from tests.browser.test_pages import LOOKS, expect_accessible

MOST_TAB_STOPS = 20
LIMIT = "[id='f-stations.1.limits.velocity']"
NOTES = "overwritten by nobody"


def opened_form(opened: Opener, template: str = "two-storeys", **options: object) -> Page:
    page = opened(f"/new?template={template}", allow=("422",), **options)
    expect(page.locator(".good")).to_be_visible()
    return page


def test_a_template_is_queued_by_few_tab_stops_and_by_no_enter_in_a_field(idle: Service, opened: Opener) -> None:
    page = opened_form(opened)
    page.evaluate("document.activeElement.blur()")
    stops = tab_to(page, "template")
    for key in ("Enter", "ArrowDown", "ArrowUp", "Enter"):
        page.keyboard.press(key)
    expect(page.locator("dialog.picker")).to_be_hidden()
    expect(page.locator("#template")).to_be_focused()
    stops += tab_to(page, "submit")
    assert stops <= MOST_TAB_STOPS
    before = idle.get("/runs?limit=1")["total"]
    duration = page.get_by_label("Duration, s")
    duration.fill("2")
    duration.press("Enter")
    page.wait_for_timeout(300)
    assert idle.get("/runs?limit=1")["total"] == before
    assert "/new" in page.url
    duration.press("Control+Enter")
    page.wait_for_url("**/runs/*")


def tab_to(page: Page, control: str) -> int:
    """Press Tab until the control has the focus; returns how often."""
    for stops in range(1, MOST_TAB_STOPS + 2):
        page.keyboard.press("Tab")
        if page.evaluate("document.activeElement.id") == control:
            return stops
    raise AssertionError(f"#{control} is not among the first {MOST_TAB_STOPS} tab stops")


def test_a_trip_is_foreseen_beside_its_field_and_queued_only_when_confirmed(idle: Service, opened: Opener) -> None:
    page = opened_form(opened, **LOOKS["dark"])
    unfold(page)
    page.get_by_label("Duration, s").fill("8")
    foreseen = page.locator("[id='e-stations.1.limits.velocity'] + .foreseen")
    expect(foreseen).to_contain_text("Dry run: ")
    page.locator(LIMIT).fill("50")
    expect(foreseen).to_contain_text("Would trip at ")
    expect(foreseen).to_contain_text("> 50 mm/s. Without limits: ")
    sentence = page.locator("#outlook")
    expect(sentence).to_contain_text("station 2 (Storey 2 damper), command velocity")
    expect(page.locator("details.fold[data-margin=over] .fold-trip")).to_have_text("would trip")
    expect(page.locator(".sketch .station-ring[data-margin=over]")).to_have_count(1)
    expect(page.locator(".peak.limit[data-margin=over]")).to_have_count(1)
    expect(page.locator(".sketch .floor-peak").first).to_contain_text("mm")
    expect_accessible(page)
    page.get_by_role("button", name="Queue the test").click()
    dialog = page.get_by_role("dialog", name="This test would trip")
    expect(dialog).to_contain_text(sentence.inner_text())
    expect_accessible(page)
    dialog.get_by_role("button", name="Back to the form").click()
    expect(page.locator(LIMIT)).to_be_focused()
    page.get_by_role("button", name="Queue the test").click()
    dialog.get_by_role("button", name="Queue the test that would trip").click()
    page.wait_for_url("**/runs/*")
    run = idle.wait(page.url.rpartition("/")[2], "tripped")
    assert run["trip"]["sentence"].startswith("Tripped at") or "Tripped at" in str(run["reason"])


def test_an_edited_form_is_neither_overwritten_nor_left_without_asking(idle: Service, opened: Opener) -> None:
    page = opened_form(opened)
    assert not asks_before_unload(page)
    notes = page.get_by_label("Notes")
    notes.fill(NOTES)
    assert asks_before_unload(page)
    dialog = page.get_by_role("dialog", name="Replace the edited plan by the template Linear viscous damper")
    pick(page, "linear-damper")
    dialog.get_by_role("button", name="Keep editing").click()
    expect(notes).to_have_value(NOTES)
    page.get_by_role("link", name="Runs", exact=True).click()
    leaving = page.get_by_role("dialog", name="Leave the edited form?")
    expect_accessible(page)
    page.keyboard.press("Escape")
    expect(leaving).to_have_count(0)
    assert "/new" in page.url
    pick(page, "linear-damper")
    dialog.get_by_role("button", name="Replace the plan").click()
    expect(page.get_by_label("Name", exact=True).first).to_have_value("Linear viscous damper in a one-storey building")
    assert not asks_before_unload(page)
    typed_while_loading(page)
    page.get_by_role("link", name="Runs", exact=True).click()
    leaving.get_by_role("button", name="Leave the form").click()
    page.wait_for_url("**/runs")


def typed_while_loading(page: Page) -> None:
    """What is typed while a template is on its way stays, unless the user lets it go."""

    def slow(route: Route) -> None:
        page.get_by_label("Notes").fill(NOTES)
        route.continue_()

    page.route("**/templates/two-storeys", slow)
    pick(page, "two-storeys")
    page.get_by_role("dialog", name="Replace the edited plan by").get_by_role("button", name="Keep editing").click()
    expect(page.get_by_label("Notes")).to_have_value(NOTES)


def pick(page: Page, template: str) -> None:
    page.get_by_role("button", name="Start from a template").click()
    page.locator(f"[data-template='{template}']").click()


def asks_before_unload(page: Page) -> bool:
    return bool(page.evaluate("!dispatchEvent(new Event('beforeunload', { cancelable: true }))"))


def test_rail_folds_and_stability_follow_the_draft(opened: Opener) -> None:
    page = opened_form(opened)
    rail = page.get_by_role("navigation", name="Sections of the plan")
    folds = page.locator("details.fold")
    expect(folds.first.locator(":scope > summary")).to_contain_text("MR damper (passive-on)")
    assert folds.evaluate_all("folds => folds.every(fold => !fold.open)")
    rail.get_by_role("link", name="Stations").click()
    expect(rail.locator("[aria-current]")).to_contain_text("Stations")
    folds.nth(1).locator(":scope > summary").click()
    page.locator(LIMIT).fill("-1")
    folds.nth(1).locator(":scope > summary").click()
    expect(rail.get_by_role("link", name="Stations 1 error")).to_be_visible()
    expect(folds.nth(1).locator(".fold-state")).to_have_text("1 error")
    page.get_by_role("link", name="Station 2, Command velocity limit").click()
    expect(page.locator(LIMIT)).to_be_focused()
    page.locator(LIMIT).fill("300")
    page.get_by_label("Name", exact=True).first.fill("A draft with a map")
    expect(page.locator(".good")).to_be_visible()
    with page.context.expect_page() as popup:
        page.get_by_role("link", name="Show the stability map of this draft").click()
    expect(popup.value.locator("#verdict")).to_contain_text("A draft with a map: predicted")


def test_the_sketch_of_a_test_without_structure_is_its_rig(opened: Opener) -> None:
    page = opened_form(opened, "specimen-mr-damper", **LOOKS["phone"])
    expect(page.get_by_role("img", name="Drawing of the rig")).to_be_visible()
    expect(page.locator(".peak.limit")).to_have_count(3)
    expect(page.get_by_role("link", name="Show the stability map")).to_be_hidden()
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth"), "the page scrolls sideways"
    choose(page, "structure-free-vibration")
    expect(page.get_by_role("img", name="Drawing of the building of 3 storeys")).to_be_visible()
    expect(page.get_by_role("region", name="Peaks of the floors").locator("tbody tr")).to_have_count(3)


def test_the_rig_is_chosen_where_there_are_several_and_its_capacities_are_compared(idle: Service, opened: Opener) -> None:
    actuators = [{"stroke": 0.25, "velocity": 0.4, "force": 1.5e6}] * 2
    rig = idle.post("/rigs", {"name": "Strong wall", "actuators": actuators})["id"]
    try:
        page = opened_form(opened)
        page.get_by_label("Rig", exact=True).select_option(label="Strong wall")
        expect(page.locator(".peak.rig .peak-words").nth(1)).to_contain_text("of 400 mm/s")
        expect(page.locator(".peak.rig")).to_have_count(6)
        expect_accessible(page)
    finally:
        idle.http.delete(f"/api/v1/rigs/{rig}")


def test_a_delay_is_identified_beside_the_compensator_and_written_only_when_asked(idle: Service, opened: Opener) -> None:
    page = opened_form(opened)
    unfold(page)
    alpha = page.locator("[id='f-stations.0.compensator.alpha_es']")
    alpha.fill("12")
    page.get_by_role("button", name="Identify delay by a short random test").first.click()
    answer = page.locator(".identified").first
    expect(answer).to_contain_text("95 % interval", timeout=90_000)
    expect(answer).to_contain_text("(now 12)")
    expect(alpha).to_have_value("12")
    expect_accessible(page)
    answer.get_by_role("button", name="Write estimate into the compensator").click()
    expect(answer).to_contain_text("Written into the fields above.")
    assert abs(float(alpha.input_value()) - 30) < 0.1
