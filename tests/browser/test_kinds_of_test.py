"""Kinds of test in the form: what does not apply is hidden, what was typed stays, drives are drawn, matrices are pasted."""

from __future__ import annotations

import re
from typing import Any

import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Page, expect

from tests.browser.checks import checked, choose, unfold
from tests.browser.conftest import Opener
from tests.browser.service import Service
from tests.browser.test_pages import LOOKS

SPREADSHEET = "50\t0\t0\r\n0\t50\t0\r\n0\t0\t40\r\n"


@pytest.fixture
def form(idle: Service, opened: Opener) -> Page:
    page = opened("/new?template=two-storeys", allow=("422",))
    expect(page.locator(".good")).to_be_visible()
    unfold(page)
    return page


def test_another_kind_of_test_hides_what_it_does_not_use_and_brings_it_back(form: Page) -> None:
    kind = form.get_by_label("Kind of test")
    form.get_by_label("Dampers in the storey").first.fill("5")
    kind.select_option("specimen")
    for heading in ("Ground motion", "Structure", "Start"):
        expect(form.get_by_role("heading", name=heading, exact=True)).to_be_hidden()
    expect(form.locator("fieldset[data-path='stations.1']")).to_be_hidden()
    expect(form.get_by_label("Dampers in the storey").first).to_be_hidden()
    shape = form.get_by_label("Shape", exact=True)
    plan = checked(form, lambda: shape.select_option("sine"), lambda plan: plan["drive"]["shape"]["kind"] == "sine")["plan"]
    assert (plan["motion"]["kind"], plan["structure"]["kind"], plan["start"]["displacement"]) == ("none", "none", [])
    assert [station["dampers"] for station in plan["stations"]] == [1]
    expect(form.locator(".good")).to_be_visible()
    plan = checked(form, lambda: kind.select_option("hybrid"), lambda plan: plan["test"] == "hybrid")["plan"]
    assert [station["dampers"] for station in plan["stations"]] == [5, 4]
    assert (plan["motion"]["kind"], plan["drive"]["shape"]["kind"]) == ("record", "still")


def test_a_drive_is_drawn_with_its_peaks_beside_the_limits(form: Page) -> None:
    choose(form, "specimen-mr-damper")
    shown = form.locator("[data-path=drive] .facts-line")
    allowed = "Peak displacement 50.00 mm (limit 80.00 mm), largest velocity 78.54 mm/s (limit 200.0 mm/s), 60.00 s"
    expect(shown).to_have_text(allowed)
    expect(form.get_by_role("img", name=re.compile("^Prescribed displacement, mm: 50"))).to_be_visible()
    form.get_by_label("Amplitude, mm").fill("90")
    expect(form.locator(".beyond")).to_have_text("Peak displacement 90.00 mm (limit 80.00 mm)")
    expect(form.locator("[id='e-drive.amplitude']")).to_contain_text("beyond the station's limit of 80 mm")


def test_matrices_are_pasted_from_a_spreadsheet_and_mistakes_told_beside_them(form: Page) -> None:
    choose(form, "structure-matrices")
    mass = form.get_by_label("Mass matrix M, t")
    expect(mass).to_have_value("50  0  0\n0  50  0\n0  0  40")
    pasted = SPREADSHEET.replace("40", "45")
    answer = checked(form, lambda: mass.fill(pasted), lambda plan: plan["structure"]["mass"][2][2] == 45e3)
    assert answer["plan"]["structure"]["mass"] == [[50e3, 0.0, 0.0], [0.0, 50e3, 0.0], [0.0, 0.0, 45e3]]
    mass.fill("50 0 0\n0 50\n0 0 40")
    expect(form.locator("[id='e-structure.mass']")).to_have_text("row 2 has 2 numbers, row 1 has 3")
    mass.fill("50 1 0\n0 50 0\n0 0 40")
    expect(form.locator("[id='e-structure.mass']")).to_contain_text("matrix M is not symmetric: M[1, 2]")


def test_samples_of_a_shape_are_pasted(form: Page) -> None:
    form.get_by_label("Kind of test").select_option("actuator")
    form.get_by_label("Shape", exact=True).select_option("samples")
    expect(form.locator("[id='e-drive.shape.values']")).to_have_text("needs at least 2 numbers")
    form.get_by_label("Time step of the samples, s").fill("0.5")
    form.get_by_label("Values as fractions of the amplitude").fill("0\n0.5\n1\n0.5\n0")
    expect(form.locator(".good")).to_be_visible()
    expect(form.locator("[data-path=drive] .facts-line")).to_contain_text("Peak displacement 20.00 mm")


def test_a_ground_motion_is_left_out_and_a_force_put_in_its_place(form: Page) -> None:
    form.get_by_role("combobox", name="Ground motion").select_option("none")
    expect(form.get_by_label("Record", exact=True)).to_have_count(0)
    add = form.get_by_role("button", name="Add a floor force")
    answer = checked(form, lambda: add.click(), lambda plan: len(plan["forces"]) == 1)
    assert answer["summary"]["pga"] is None
    form.get_by_label("Floor", exact=True).fill("3")
    expect(form.locator("[id='e-forces.0.floor']")).to_contain_text("the structure has 2 floors")


def test_the_controller_of_a_current_is_chosen_with_its_fields(form: Page) -> None:
    choose(form, "semi-active")
    kind = form.locator("[id='f-stations.0.controller.kind']")
    expect(kind).to_have_value("clipped_optimal")
    answer = checked(form, lambda: kind.select_option("on_off"), lambda plan: _controller(plan)["kind"] == "on_off")
    assert _controller(answer["plan"]) == {"kind": "on_off", "off_current": 0.0, "on_current": 2.5}
    form.get_by_label("Current when on, A").fill("-1")
    expect(form.locator("[id='e-stations.0.controller.on_current']")).to_have_text("needs at least 0 A")


def _controller(plan: dict[str, Any]) -> dict[str, Any]:
    found: dict[str, Any] = plan["stations"][0]["controller"] if plan["stations"] else {"kind": ""}
    return found


# the charts of the first screen, then the charts below it
RUNS = {
    "specimen-mr-damper": (
        "light",
        ["Force against displacement", "Displacement", "Measured force", "Tracking error", "Command velocity"],
    ),
    "actuator-sweep": (
        "dark",
        [
            "Force against displacement",
            "Displacement",
            "Tracking error",
            "Tracking indicator",
            "Synchronisation subspace",
            "Measured force",
            "Command velocity",
        ],
    ),
    "semi-active": (
        "phone",
        [
            "Force against displacement",
            "Displacement",
            "Tracking error",
            "Tracking indicator",
            "Adaptation Δα",
            "Synchronisation subspace",
            "Measured force",
            "Command velocity",
            "Current",
            "Energy error",
            "Floor displacement relative to the ground",
            "Ground acceleration",
        ],
    ),
    "structure-free-vibration": ("phone", ["Floor displacement relative to the ground"]),
    "structure-matrices": ("light", ["Floor displacement relative to the ground", "Force on floor 3"]),
    "structure-earthquake": ("dark", ["Floor displacement relative to the ground", "Ground acceleration"]),
}


@pytest.mark.parametrize("template", RUNS)
def test_a_run_shows_the_charts_of_its_kind_of_test_and_none_that_is_empty(
    template: str, idle: Service, opened: Opener
) -> None:
    look, charts = RUNS[template]
    page = opened(f"/runs/{idle.completed(template=template, duration=3.0)}", **LOOKS[look])
    expect(page.locator("#metrics tbody tr").first).to_be_visible()
    expect(page.locator(".chart canvas").first).to_be_visible()
    titles = [title.split(", ")[0] for title in page.locator(".chart figcaption strong").all_text_contents()]
    assert titles == charts
    stability = page.locator("#actions").get_by_role("link", name="Stability")
    expect(stability).to_have_count(0 if template.startswith(("specimen", "actuator")) else 1)
    _expect_whole(page)


@pytest.mark.parametrize(("template", "look"), [("specimen-mr-damper", "dark"), ("structure-matrices", "phone")])
def test_the_form_of_other_kinds_of_test_is_whole_and_accessible(
    template: str, look: str, idle: Service, opened: Opener
) -> None:
    page = opened(f"/new?template={template}", **LOOKS[look])
    expect(page.locator(".good")).to_be_visible()
    _expect_whole(page)


def test_a_test_without_a_loop_has_no_stability_and_says_so(opened: Opener) -> None:
    page = opened("/stability/specimen-mr-damper")
    expect(page.locator("#verdict")).to_contain_text("follows its drive. It has no closed loop that can become unstable")
    expect(page.locator("table").first).to_be_hidden()


def _expect_whole(page: Page) -> None:
    found = Axe().run(page)
    assert found.violations_count == 0, found.generate_report()
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth"), "the page scrolls sideways"
