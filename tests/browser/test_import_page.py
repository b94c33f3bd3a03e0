"""The import page: what stands in a file, a refused line, rates, lags, samples under the cursor, and saved mappings."""

from __future__ import annotations

from pathlib import Path

import h5py
import numpy as np
import pytest
from playwright.sync_api import Page, expect

from tests.browser.conftest import Opener
from tests.browser.test_pages import LOOKS, expect_accessible
from tests.browser.test_recordings import chosen, csv

LAG = 0.037  # s


def motion(t: np.ndarray) -> np.ndarray:
    found: np.ndarray = 20 * np.sin(2 * np.pi * 0.7 * t) + 6 * np.sin(2 * np.pi * 1.9 * t)
    return found


@pytest.fixture
def two_clocks(tmp_path: Path) -> Path:
    """A command at 1000 Hz and a displacement at 512 Hz that follows it 37 ms later."""
    path = tmp_path / "clocks.h5"
    command, measured = np.arange(10_000) / 1000, np.arange(5_120) / 512
    with h5py.File(path, "w") as file:
        for name, times, values in (("command", command, motion(command)), ("displacement", measured, motion(measured - LAG))):
            file.create_dataset(name, data=values).attrs.update(unit="mm", dt=float(times[1]))
    return path


def at2(folder: Path, count: int = 400) -> Path:
    path = folder / "record.AT2"
    values = "\n".join(" ".join(f"{0.1 * np.sin((k + j) / 9):.6f}" for j in range(5)) for k in range(0, 400, 5))
    path.write_text(f"PEER\nTITLE\nACCELERATION TIME SERIES IN UNITS OF G\nNPTS=  {count}, DT=   .0100 SEC\n{values}")
    return path


def test_a_file_shows_its_header_what_it_states_and_its_first_rows(opened: Opener, tmp_path: Path) -> None:
    page = opened("/recordings")
    chosen(page, at2(tmp_path))
    expect(page.get_by_role("region", name="Header of the file")).to_contain_text("NPTS=  400, DT=   .0100 SEC")
    stated = page.get_by_role("region", name="What the header states").get_by_role("row", name="number of samples")
    for text in ("line 4", "400", "agrees"):
        expect(stated).to_contain_text(text)
    expect(page.get_by_role("region", name="First rows of numbers").locator("tbody tr")).to_have_count(8)


def test_a_file_whose_header_contradicts_its_data_is_refused_with_the_line(opened: Opener, tmp_path: Path) -> None:
    page = opened("/recordings", allow=("422",))
    page.get_by_label("File of measurements").set_input_files(at2(tmp_path, count=500))
    alert = page.locator("#refusal")
    expect(alert).to_contain_text("line 4: states a number of samples of 500; the data have 400")
    lines = page.get_by_role("region", name="Lines 2 to 6 of the file")
    expect(lines.locator(".named")).to_contain_text("NPTS=  500")
    expect_accessible(page)


def test_a_rate_is_asked_for_where_nothing_states_it_and_its_meaning_is_said(opened: Opener, tmp_path: Path) -> None:
    page = opened("/recordings", allow=("422",))
    path = tmp_path / "counted.csv"
    path.write_text("\n".join(["Sample,Disp (mm)", *(f"{k},{12 * np.sin(k / 30):.3f}" for k in range(600))]))
    chosen(page, path)
    rate = page.get_by_label("Sampling rate or step of the file")
    expect(page.get_by_text("the file does not state it: give the rate, or the step")).to_be_visible()
    rate.fill("4")
    expect(page.get_by_text("4.000 Hz, 250.0 ms: 600 samples last 149.8 s")).to_be_visible()
    page.get_by_label("Unit of the rate or step").select_option("ms")
    expect(page.get_by_text("250.0 Hz, 4.000 ms: 600 samples last 2.396 s")).to_be_visible()
    expect(page.get_by_text("600 samples at 250 Hz, 2.396 s: no errors or warnings")).to_be_visible()


def test_a_lag_between_two_clocks_is_offered_and_applied_only_on_request(opened: Opener, two_clocks: Path) -> None:
    page = opened("/recordings")
    chosen(page, two_clocks)
    lags = page.get_by_role("region", name="Lags between channels")
    expect(lags).to_contain_text("x_meas.1 is 37 ms behind x_cmd.1")
    lag = page.get_by_label("Lag, ms, of displacement")
    expect(lag).to_have_value("")
    row = page.locator("tr", has=lag)
    expect(row).to_contain_text("Clock of the recording: from 512 Hz to 1000 Hz by a zero-phase polyphase filter.")
    lags.get_by_role("button", name="Apply lag to x_meas.1").press("Enter")
    expect(lag).to_be_focused()
    assert float(lag.input_value()) == pytest.approx(37, abs=0.1)
    expect(row).to_contain_text("times reduced by a lag of 37")
    expect(lags.get_by_role("button")).to_have_count(0)
    expect_accessible(page)


def test_the_cursor_stands_on_samples_and_a_zoom_shows_all_of_them(opened: Opener, two_clocks: Path) -> None:
    page = opened("/recordings")
    chosen(page, two_clocks)
    figure = page.locator("figure", has=page.get_by_label("Sample of Command displacement, station 1, mm"))
    slider, reading = figure.get_by_role("slider"), figure.locator("output")
    expect(reading).to_contain_text("of 10000 samples: the extremes")
    slider.focus()
    slider.press("Home")
    slider.press("ArrowRight")
    for _ in range(3):
        samples = str(slider.get_attribute("max"))
        slider.press("+")
        expect(slider).not_to_have_attribute("max", samples)
    slider.press("ArrowRight")
    expect(slider).to_have_attribute("aria-valuetext", reading.inner_text())
    time = float(reading.inner_text().split(" at ")[1].removesuffix(" s"))
    assert time * 1000 == pytest.approx(round(time * 1000), abs=1e-6)
    assert float(reading.inner_text().split(" mm")[0]) == pytest.approx(float(motion(np.array(time))), rel=1e-4)
    slider.press("Escape")
    expect(reading).to_contain_text("mm at")


def test_a_mapping_is_saved_proposed_again_renamed_and_deleted(opened: Opener, tmp_path: Path) -> None:
    page = opened("/recordings", allow=("409",))
    chosen(page, csv(tmp_path, "Rod travel (mm)", "first.csv"))
    page.get_by_label("Offset of Rod travel (mm)").fill("0.25")
    page.get_by_label("Name of the mapping").fill("Rod rig")
    page.get_by_label("Name of the mapping").press("Enter")
    expect(page.get_by_text("The mapping was saved as Rod rig.")).to_be_visible()
    listed = page.get_by_role("region", name="Table of the saved mappings")
    expect(listed.get_by_role("row", name="Rod rig")).to_contain_text("Rod travel (mm)")
    page.get_by_label("Name of the mapping").fill("Rod rig")
    page.get_by_role("button", name="Save the mapping").click()
    expect(page.get_by_text("A saved mapping is named Rod rig already")).to_be_visible()
    chosen(page, csv(tmp_path, "Rod travel (mm)", "second.csv"))
    expect(page.get_by_label("Offset of Rod travel (mm)")).to_have_value("0.25")
    expect(page.get_by_text("1 saved for files of this layout")).to_be_visible()
    expect_accessible(page)
    listed.get_by_role("button", name="Rename mapping Rod rig").click()
    name = page.get_by_label("New name of mapping Rod rig")
    expect(name).to_be_focused()
    name.fill("Rod rig, 50 kN")
    name.press("Enter")
    expect(listed.get_by_role("button", name="Delete mapping Rod rig, 50 kN")).to_be_visible()
    page.on("dialog", lambda dialog: dialog.accept())
    listed.get_by_role("button", name="Delete mapping Rod rig, 50 kN").click()
    expect(page.get_by_text("There is no saved mapping yet")).to_be_visible()


@pytest.mark.parametrize("look", LOOKS)
def test_the_import_page_is_accessible_and_within_its_width(look: str, opened: Opener, two_clocks: Path) -> None:
    page: Page = opened("/recordings", **LOOKS[look])
    chosen(page, two_clocks)
    expect(page.locator("#work canvas").first).to_be_visible()
    expect_accessible(page)
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth"), "the page scrolls sideways"
