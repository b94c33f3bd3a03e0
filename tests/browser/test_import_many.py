"""Many files imported by one mapping in the browser: by mouse, by keyboard, on a phone; the table says what differs."""

from __future__ import annotations

import csv
from pathlib import Path

import pytest
from playwright.sync_api import Locator, Page, expect

from rths_engine.recordings.measured import Mapping, mapping_yaml
from tests.browser.conftest import Opener, visit
from tests.browser.service import Service
from tests.browser.test_pages import LOOKS, expect_accessible
from tests.engine import batch_files as made


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "tests.zip").write_bytes(made.zipped(made.fifty()))
    (tmp_path / "map.yaml").write_text(mapping_yaml.write(Mapping.read(made.mapping())), encoding="utf-8")
    for number in range(3):
        (tmp_path / made.name(number)).write_bytes(made.file(number))
    return tmp_path


def row(page: Page, name: str) -> Locator:
    return page.locator("tbody tr", has=page.get_by_role("rowheader", name=name))


def test_a_zip_of_fifty_files_is_imported_and_its_table_read_and_downloaded(opened: Opener, folder: Path) -> None:
    page = opened("/recordings", **LOOKS["phone"])  # test_pages opens this table of fifty files in every look
    expect_accessible(page)
    page.get_by_label("Files or ZIP archive").set_input_files(folder / "tests.zip")
    page.get_by_label("YAML file with the mapping").set_input_files(folder / "map.yaml")
    page.get_by_role("button", name="Import the files").click()
    expect(page.get_by_role("heading", name="Batch of 50 files: 47 imported, 3 refused")).to_be_visible()
    expect(page.locator("tbody tr")).to_have_count(50)
    for name, text in (
        ("run11.csv", "unit of column 'Force (N)': N; in the other files kN"),
        ("run17.csv", "column 'Force (kN)': missing"),
        ("run23.csv", "Check: sampling rate: 50 Hz; in the other files 100 Hz"),
        ("run31.csv", "Refused: line 92 = cable loose"),
        ("run37.csv", "order of columns: Time (s), Force (kN), Disp (mm)"),
    ):
        expect(row(page, name)).to_contain_text(text)
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth"), "the page scrolls sideways"
    expect_accessible(page)
    with page.expect_download() as download:
        page.get_by_role("link", name="Table, CSV").click()
    with Path(download.value.path()).open(encoding="utf-8", newline="") as file:
        assert sum(one["result"] == "imported" for one in csv.DictReader(file)) == 47


def test_several_files_are_imported_by_keyboard_with_a_saved_mapping(opened: Opener, folder: Path, service: Service) -> None:
    sent = service.http.post("/api/v1/recordings/files", files={"file": ("a.csv", made.file(0))}).json()
    saved = service.post("/mappings", {"file": sent["sha256"], "mapping": made.mapping(), "name": "Damper rig"})
    page = opened("/recordings")
    page.get_by_label("Files or ZIP archive").set_input_files([folder / made.name(number) for number in range(3)])
    chosen = page.get_by_label("Mapping of all files")
    expect(chosen.locator("option", has_text="Damper rig")).to_have_count(1)
    chosen.focus()
    page.keyboard.type("Damper rig")
    expect(chosen.locator("option:checked")).to_have_text("Damper rig")
    expect(page.get_by_label("YAML file with the mapping")).to_be_hidden()
    for label in ("Imported by", "Take the units and the step of the mapping"):
        page.keyboard.press("Tab")
        expect(page.get_by_label(label)).to_be_focused()
    page.keyboard.press("Tab")
    page.keyboard.press("Enter")
    expect(page.get_by_role("heading", name="Batch of 3 files: 3 imported, 0 refused")).to_be_visible()
    page.get_by_role("link", name="run01.csv").click()
    expect(page.get_by_role("heading", name="run01", exact=True)).to_be_visible()
    visit(page, "/recordings")
    expect(page.get_by_role("link", name="3 imported, 0 refused").first).to_be_visible()
    service.http.delete(f"/api/v1/mappings/{saved['id']}").raise_for_status()


def test_what_is_missing_is_said_at_its_field_and_a_refusal_below(opened: Opener, folder: Path) -> None:
    page = opened("/recordings", allow=("422",))
    button = page.get_by_role("button", name="Import the files")
    button.click()
    expect(page.get_by_label("Files or ZIP archive")).to_be_focused()
    expect(page.locator("#many-files-error")).to_have_text("Choose files of measurements, or a ZIP archive of such files.")
    expect_accessible(page)
    (folder / "bad.zip").write_bytes(b"1,2")
    page.get_by_label("Files or ZIP archive").set_input_files(folder / "bad.zip")
    button.click()
    expect(page.get_by_label("YAML file with the mapping")).to_be_focused()
    page.get_by_label("YAML file with the mapping").set_input_files(folder / "map.yaml")
    button.click()
    expect(page.locator("#many-refusal")).to_contain_text("bad.zip: is not a complete ZIP archive")
    expect(button).to_be_enabled()


def test_a_refused_file_is_opened_alone(opened: Opener, folder: Path) -> None:
    page = opened("/recordings")
    page.get_by_label("Files or ZIP archive").set_input_files(folder / "tests.zip")
    page.get_by_label("YAML file with the mapping").set_input_files(folder / "map.yaml")
    page.get_by_role("button", name="Import the files").click()
    page.get_by_role("link", name="Open run11.csv alone").click()
    expect(page.get_by_role("form", name="Mapping of run11.csv")).to_be_visible()
