"""Measurements brought in by the browser: a unit corrected, imported, found again; by mouse, by keyboard, on a phone."""

from __future__ import annotations

from pathlib import Path

import h5py
import numpy as np
import pytest
from playwright.sync_api import Page, expect

from tests.browser.conftest import Opener, visit
from tests.browser.test_pages import expect_accessible

T = np.arange(0, 4, 0.01)
X = 20 * np.sin(2 * np.pi * 0.5 * T)  # mm
V = 20 * np.pi * np.cos(2 * np.pi * 0.5 * T)  # mm/s
FORCE = 0.5 * np.sign(V)  # kN


def csv(folder: Path, heading: str, name: str = "damper.csv") -> Path:
    """A friction damper's test; `heading` names the displacement's column."""
    path = folder / name
    rows = np.column_stack([T, X, V, FORCE])
    np.savetxt(path, rows, "%.6g", ",", header=f"t (s),{heading},Vel (mm/s),Force (kN)", comments="")
    return path


def chosen(page: Page, path: Path) -> None:
    page.get_by_label("File of measurements").set_input_files(path)
    expect(page.get_by_role("form", name=f"Mapping of {path.name}")).to_be_visible()


def test_a_wrong_unit_is_seen_corrected_and_the_recording_imported_and_listed(opened: Opener, tmp_path: Path) -> None:
    page = opened("/recordings")
    chosen(page, csv(tmp_path, "Disp (m)"))
    expect(page.get_by_label("Role of Vel (mm/s)")).to_have_value("v_meas")
    velocity = page.locator("tr", has=page.get_by_label("Role of Vel (mm/s)"))
    expect(velocity).to_contain_text("Error: does not have the magnitude of the derivative of x_meas.1")
    page.get_by_label("Unit of Disp (m)").select_option("mm")
    expect(page.get_by_text("400 samples at 100 Hz, 3.99 s: 1 warning")).to_be_visible()
    displacement = page.locator("tr", has=page.get_by_label("Role of Disp (m)"))
    expect(displacement).to_contain_text("Warning: the file states m for column 'Disp (m)'; the mapping says mm")
    expect(velocity).not_to_contain_text("Error")
    expect(page.get_by_role("img", name="Force against displacement, station 1")).to_be_visible()
    expect_accessible(page)
    page.get_by_label("Name of the recording").fill("Friction damper, 20 mm")
    page.get_by_role("button", name="Import the recording").click()
    expect(page.get_by_role("heading", name="Friction damper, 20 mm")).to_be_visible()
    expect(page.get_by_role("img", name="Measured displacement, station 1, mm: -20.00 to 20.00 mm")).to_be_visible()
    page.get_by_role("link", name="Recordings", exact=True).click()
    row = page.locator("tr", has=page.get_by_role("link", name="Friction damper, 20 mm", exact=True))
    for text in ("specimen", "x_meas.1, v_meas.1, f_meas.1", "100", "3.99", "Ana Ruiz"):
        expect(row).to_contain_text(text)
    with page.expect_download() as download:
        row.get_by_role("link", name="HDF5").click()
    download.value.save_as(tmp_path / "one.h5")
    with h5py.File(tmp_path / "one.h5") as file:
        assert np.ptp(file["x_meas.1"][:]) == pytest.approx(0.04, rel=1e-3)  # six digits in the file


def test_an_earlier_mapping_is_offered_and_can_be_used_and_a_recording_deleted(opened: Opener, tmp_path: Path) -> None:
    page = opened("/recordings")
    for name in ("first.csv", "second.csv"):
        chosen(page, csv(tmp_path, "Brace travel (mm)", name))
        if name == "second.csv":
            expect(page.get_by_text("1 earlier mapping fits this file")).to_be_visible()
            page.get_by_label("Mapping", exact=True).select_option(label=expected_offer(page))
            expect(page.get_by_label("Offset of Brace travel (mm)")).to_have_value("0.25")
        else:
            page.get_by_label("Offset of Brace travel (mm)").fill("0.25")
        page.get_by_role("button", name="Import the recording").click()
        expect(page.get_by_role("heading", name=name.partition(".")[0], exact=True)).to_be_visible()
        if name == "first.csv":
            visit(page, "/recordings")
    page.on("dialog", lambda dialog: dialog.accept())
    page.get_by_role("button", name="Delete second").click()
    page.wait_for_url("**/recordings")
    expect(page.get_by_role("link", name="first", exact=True)).to_be_visible()
    expect(page.get_by_role("link", name="second", exact=True)).to_have_count(0)


def test_a_unit_that_the_file_does_not_state_is_chosen_before_the_import(opened: Opener, tmp_path: Path) -> None:
    page = opened("/recordings", allow=("422",))
    chosen(page, csv(tmp_path, "Disp", "unstated.csv"))
    unit = page.get_by_label("Unit of Disp")
    expect(unit).to_have_value("")
    row = page.locator("tr", has=unit)
    expect(row).to_contain_text("A guess by its name alone; the file states no unit: choose it; mm would fit its magnitude")
    expect(row).to_contain_text("Error: the unit of column 'Disp' is not stated: choose the unit")
    page.get_by_role("button", name="Import the recording").click()
    expect(page.get_by_label("Role of Disp")).to_be_focused()
    unit.select_option("mm")
    expect(page.get_by_text("no errors or warnings")).to_be_visible()
    page.get_by_role("button", name="Import the recording").click()
    expect(page.get_by_role("heading", name="unstated", exact=True)).to_be_visible()


def expected_offer(page: Page) -> str:
    return page.get_by_label("Mapping", exact=True).locator("option").nth(1).inner_text()


def test_a_file_is_imported_by_keyboard_and_a_refusal_leads_to_its_column(opened: Opener, tmp_path: Path) -> None:
    page = opened("/recordings", allow=("422",))
    chosen(page, csv(tmp_path, "Disp (mm)", "keys.csv"))
    expect(page.get_by_text("no errors or warnings")).to_be_visible()
    gain = page.get_by_label("Gain of Force (kN)")
    gain.focus()
    page.keyboard.type("zero")
    force = page.locator("tr", has=gain)
    expect(force).to_contain_text("Error: gain 'zero' needs a factor")
    page.get_by_role("button", name="Import the recording").focus()
    page.keyboard.press("Enter")
    expect(page.get_by_label("Role of Force (kN)")).to_be_focused()
    for _ in range(3):
        page.keyboard.press("Tab")
    expect(gain).to_be_focused()
    page.keyboard.press("ControlOrMeta+A")
    page.keyboard.type("1.5")
    expect(page.get_by_text("no errors or warnings")).to_be_visible()
    page.keyboard.press("Enter")
    expect(page.get_by_role("heading", name="keys", exact=True)).to_be_visible()


def test_the_mapping_is_worked_out_within_a_phones_width(opened: Opener, tmp_path: Path) -> None:
    page = opened("/recordings", viewport={"width": 390, "height": 800})
    chosen(page, csv(tmp_path, "Disp (mm)", "phone.csv"))
    expect(page.get_by_text("no errors or warnings")).to_be_visible()
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth"), "the page scrolls sideways"
    unit = page.get_by_label("Unit of Force (kN)")
    box = unit.bounding_box()
    assert box is not None and box["x"] >= 0 and box["x"] + box["width"] <= 390
    expect_accessible(page)


def test_a_file_that_cannot_be_read_says_why(opened: Opener, tmp_path: Path) -> None:
    page = opened("/recordings", allow=("422",))
    path = tmp_path / "letter.txt"
    path.write_text("Dear colleague,\nthe measurements are on their way.\n")
    page.get_by_label("File of measurements").set_input_files(path)
    expect(page.get_by_role("alert")).to_contain_text("is not a row of numbers")
    expect(page.get_by_role("form")).to_have_count(0)


def test_an_unknown_recording_says_so(opened: Opener) -> None:
    page = opened("/recordings/not-a-recording", allow=("404",))
    expect(page.get_by_text("There is no recording not-a-recording.")).to_be_visible()
