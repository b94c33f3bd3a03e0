"""The form: from a plan to a queued test, by mouse and by keyboard, with mistakes shown where they are."""

from __future__ import annotations

import math
import os
import re
from pathlib import Path
from typing import Any

import h5py
import pytest
from playwright.sync_api import Page, expect

from tests.browser.checks import checked, choose, unfold
from tests.browser.conftest import Opener
from tests.browser.service import Service
from tests.browser.test_pages import expect_accessible
from tests.engine.formats.writers import mseed


@pytest.fixture
def form(idle: Service, opened: Opener) -> Page:
    page = opened("/new?template=two-storeys", allow=("422",))
    expect(page.locator(".good")).to_be_visible()
    unfold(page)
    return page


def test_a_test_is_submitted_watched_to_its_end_and_its_recording_downloaded(form: Page, tmp_path: Path) -> None:
    form.get_by_label("Duration, s").fill("5")
    form.get_by_role("button", name="Queue the test").click()
    form.wait_for_url("**/runs/*")
    expect(form.locator("#state")).to_have_text("completed")
    expect(form.get_by_role("region", name="Measures of each station", exact=True).locator("tbody tr")).to_have_count(2)
    expect(form.locator("#clock")).to_contain_text("5.00 of 5.00 s simulated")
    expect(form.locator(".chart canvas").first).to_be_visible()
    form.get_by_text("Download", exact=True).click()
    with form.expect_download() as download:
        form.get_by_role("link", name="Recording, HDF5").click()
    path = tmp_path / "recording.h5"
    download.value.save_as(path)
    with h5py.File(path) as file:
        assert len(file.keys()) > 0


def test_a_mistake_is_shown_beside_its_field_in_its_unit_and_focused_on_submit(form: Page) -> None:
    alpha = form.get_by_label("Delay constant α", exact=True).first
    alpha.fill("0.2")
    expect(form.locator("[id='e-stations.0.actuator.alpha']")).to_have_text("needs at least 1")
    stroke = form.get_by_label("Command displacement limit, mm").first
    stroke.fill("20000")
    expect(form.locator("[id='e-stations.0.limits.displacement']")).to_have_text("needs at most 10000 mm")
    assert "e-stations.0.limits.displacement" in (stroke.get_attribute("aria-describedby") or "")
    form.get_by_role("button", name="Queue the test").click()
    expect(alpha).to_be_focused()
    expect(alpha).to_have_attribute("aria-invalid", "true")


def test_a_mistake_only_the_service_knows_is_shown_beside_its_field(form: Page) -> None:
    form.get_by_label("Substeps per step n").fill("7")
    expect(form.locator("[id='e-integrator.dt']")).to_contain_text("controller steps, but a step has 7 substeps")


def test_a_value_may_be_typed_with_its_own_unit(form: Page) -> None:
    field = form.get_by_label("Velocity limit, mm/s", exact=True).first
    before = float(field.input_value()) / 1e3
    typed = checked(form, lambda: field.fill("22 in/s"), lambda plan: _velocity_limit(plan) != pytest.approx(before))
    limit = _velocity_limit(typed["plan"])
    assert limit == pytest.approx(22 * 0.0254)  # equal but for the rounding of the product


def test_without_a_name_the_form_asks_for_it(idle: Service, opened: Opener) -> None:
    page = opened("/new", who="")
    expect(page.locator(".good")).to_be_visible()
    page.get_by_role("button", name="Queue the test").click()
    expect(page.get_by_label("Your name")).to_be_focused()
    expect(page.locator("#e-who")).to_contain_text("is required")


def test_a_plan_exported_and_imported_is_the_same_plan(form: Page, tmp_path: Path) -> None:
    choose(form, "table3-09")
    expect(form.get_by_label("Name", exact=True).first).to_have_value("Table III, simulation 9 (α_es = 1 and 60, kp = 0.4)")
    digest = _digest(form)
    with form.expect_download() as download:
        form.get_by_role("button", name="Export the plan as YAML").click()
    path = tmp_path / "plan.yaml"
    download.value.save_as(path)
    choose(form, "table3-02")
    expect(form.get_by_label("Name", exact=True).first).to_have_value("Table III, simulation 2 (α_es = 1 and 1, kp = 0.4)")
    assert _digest(form) != digest
    form.get_by_label("Import a plan from YAML").set_input_files(path)
    form.get_by_role("button", name="Replace the plan").click()
    expect(form.get_by_label("Name", exact=True).first).to_have_value("Table III, simulation 9 (α_es = 1 and 60, kp = 0.4)")
    assert _digest(form) == digest


def test_stations_are_duplicated_and_removed_and_their_parts_exchanged(form: Page) -> None:
    form.get_by_role("button", name="Duplicate station 2").click()
    third = form.locator("fieldset[data-path='stations.2']")
    expect(third.get_by_label("Name", exact=True)).to_have_value("Storey 2 damper 2")
    third.get_by_label("Specimen", exact=True).select_option("linear")
    expect(third.get_by_label("Damping coefficient, kN·s/m")).to_have_value("500")
    form.get_by_label("Storey 2 damper 2: Specimen", exact=True).select_option("nominal")
    form.get_by_role("button", name="Remove station 1").click()
    expect(form.locator("fieldset[data-path='stations.2']")).to_have_count(0)
    expect(form.locator("fieldset[data-path='stations.1']").get_by_label("Specimen", exact=True)).to_have_value("linear")
    stated = form.get_by_label("Storey 2 damper 2: Specimen", exact=True)
    expect(stated).to_have_value("nominal")  # the statement stays with its station
    plan = checked(form, lambda: stated.select_option("guess"), lambda plan: "guess" in plan["known"].values())["plan"]
    assert plan["known"] == {"stations.1.specimen": "guess"}
    expect(form.locator(".good")).to_be_visible()


def test_a_station_becomes_an_external_rig_in_its_folded_connection(form: Page) -> None:
    connection = form.locator("details.subfold").first
    connection.locator("summary").click()
    connection.locator("select").first.select_option("generic_client")
    expect(connection.locator("summary")).to_have_text("Connection: Generic TCP or UDP server")
    connection.get_by_label("Port", exact=True).fill("9000")
    expect(form.locator(".fold-facts").first).to_contain_text("External: Generic TCP or UDP server")
    expect(form.get_by_text("has no clock that the rig of station 1 (Storey 1 damper) could follow").first).to_be_visible()
    form.locator("[id='f-pace.kind']").select_option("real_time")
    expect(form.get_by_text("has no clock")).to_have_count(0)
    expect(form.locator("[aria-invalid=true]")).to_have_count(0)
    expect_accessible(form)


def test_a_record_is_previewed_and_added_to_the_library(form: Page, tmp_path: Path) -> None:
    record = tmp_path / "Site shake.txt"
    record.write_text("\n".join(f"{0.3 * ((-1) ** n) * n / 400:.6f}" for n in range(400)))
    form.get_by_text("Upload a record").click()
    expect(form.get_by_label("Time step, s")).to_be_hidden()
    form.get_by_label("File").set_input_files(record)
    expect(form.locator(".upload")).to_contain_text("Give the unit and the time step.")
    expect(form.get_by_role("button", name="Add to the library")).to_be_disabled()
    form.get_by_label("Time step, s").fill("0.01")
    expect(form.locator(".upload")).to_contain_text("100.0 Hz, 10.00 ms: 400 samples last 3.990 s")
    form.get_by_label("Unit of the acceleration").select_option("g")
    expect(form.locator(".upload .preview canvas").first).to_be_visible()
    form.get_by_role("button", name="Add to the library").click()
    expect(form.get_by_label("Record", exact=True)).to_have_value("site-shake")
    expect(form.locator(".good")).to_be_visible()


def test_a_channel_of_a_file_is_chosen_by_name_and_what_the_file_states_is_not_asked_for(form: Page, tmp_path: Path) -> None:
    record = tmp_path / "Site.csv"
    rows = [f"{0.01 * k:.2f},{0.2 * math.sin(k / 9):.6f},{0.1 * math.cos(k / 7):.6f}" for k in range(400)]
    record.write_text("\n".join(["time (s),N-S,E-W", *rows]))
    form.get_by_text("Upload a record").click()
    form.get_by_label("File").set_input_files(record)
    upload = form.locator(".upload")
    expect(upload.get_by_role("region", name="First rows of numbers")).to_contain_text("0.022177")
    expect(upload).to_contain_text("Give the channel.")
    channel = form.get_by_label("Channel", exact=True)
    expect(channel.locator("option")).to_have_count(3)
    channel.select_option("2")
    expect(form.get_by_label("Time step, s")).to_be_hidden()
    expect(upload).to_contain_text("Give the unit.")
    form.get_by_label("Unit of the acceleration").select_option("g")
    expect(upload).to_contain_text("PGA 0.1 g, 3.990 s in steps of 0.01 s")
    expect_accessible(form)
    form.get_by_role("button", name="Add to the library").click()
    expect(form.get_by_label("Record", exact=True)).to_have_value(re.compile("site"))


def test_a_record_in_counts_asks_for_the_acceleration_of_one_count(form: Page, tmp_path: Path) -> None:
    record = tmp_path / "valb.mseed"
    record.write_bytes(mseed.written(mseed.Channel("BK.VALB.40.HN1", [round(1e5 * math.sin(k / 9)) for k in range(1000)])))
    form.get_by_text("Upload a record").click()
    form.get_by_label("File").set_input_files(record)
    expect(form.locator(".upload")).to_contain_text("Give the acceleration of one count.")
    form.get_by_label("Acceleration of one count").fill("1e-5 m/s^2")
    expect(form.locator(".upload")).to_contain_text("PGA 0.103 g, 4.995 s in steps of 0.005 s")


def test_a_refused_line_of_a_record_is_shown_with_its_neighbours(form: Page, tmp_path: Path) -> None:
    record = tmp_path / "Gap.txt"
    record.write_text("\n".join([*(f"{k / 1000}" for k in range(100)), "cable", *["0.05"] * 400]))
    form.get_by_text("Upload a record").click()
    form.get_by_label("File").set_input_files(record)
    lines = form.locator(".upload").get_by_role("region", name="Lines 99 to 103 of the file")
    expect(lines).to_contain_text("101cable")


def test_two_gigabytes_are_refused_before_they_are_sent(form: Page, tmp_path: Path) -> None:
    huge = tmp_path / "huge.AT2"
    huge.touch()
    os.truncate(huge, 2 << 30)
    form.get_by_text("Upload a record").click()
    form.get_by_label("File").set_input_files(huge)
    alert = form.locator(".upload").get_by_role("alert")
    expect(alert).to_have_text("huge.AT2 is too large: 2147.5 MB. The largest accepted size is 20 MB.")
    form.get_by_label("Import a plan").set_input_files(huge)
    expect(form.locator("#verdict .error")).to_contain_text("The largest accepted size is 20 MB")


def _velocity_limit(plan: dict[str, Any]) -> float:
    limit: float = plan["stations"][0]["actuator"]["velocity_limit"]
    return limit


def _digest(form: Page) -> str:
    """The digest of the plan whose name the form shows."""
    name = form.get_by_label("Name", exact=True).first.input_value()
    notes = form.get_by_label("Notes")
    digest: str = checked(form, lambda: notes.dispatch_event("input"), lambda plan: plan["name"] == name)["digest"]
    return digest
