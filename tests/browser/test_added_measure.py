"""A measure is added by one entry and a generated migration: REST, run page, lists, report, CSV and database then have it."""

from __future__ import annotations

import csv
import io
import shutil
import sqlite3
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import h5py
import numpy as np
import pytest
from playwright.sync_api import Browser, expect

from app import db
from rths_engine.recordings import run_file
from tests.browser.conftest import visit
from tests.browser.service import ROOT, STARTED_WITHIN_S, Service, importing, running

KEY, HEADING = "mean_force_kN", "Mean force, kN"


@pytest.fixture(scope="module")
def added(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder whose `sitecustomize` adds the measure, with the migrations and the one that was generated for it."""
    folder = tmp_path_factory.mktemp("added")
    shutil.copy(Path(__file__).with_name("added_measure.py"), folder / "sitecustomize.py")
    shutil.copytree(db.MIGRATIONS, folder / "migrations", ignore=shutil.ignore_patterns("__pycache__"))
    command = [sys.executable, "-m", "app.new_migration", "Mean force"]
    subprocess.run(command, cwd=ROOT, env=importing(folder), check=True, capture_output=True, timeout=120)
    return folder


@pytest.fixture(scope="module")
def extended(browser: Browser, added: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[Service, str]]:
    """A service with the measure, and a run that it has executed."""
    with running(tmp_path_factory.mktemp("extended"), added, calculating=True) as service:
        run = service.submit(duration=3.0)
        service.wait(run, "completed", within_s=STARTED_WITHIN_S)
        yield service, run


def expected(service: Service, run_id: str) -> list[float]:
    """The measure of both stations, from the recording."""
    recording = run_file.load(service.data / "recordings" / f"{run_id}.h5")
    return [float(np.mean(np.abs(recording.signal(f"f_meas.{number}")))) / 1e3 for number in (1, 2)]


def test_the_generated_migration_adds_its_column_alone(added: Path) -> None:
    (written,) = (added / "migrations" / "versions").glob("*_mean_force.py")
    text = written.read_text()
    assert text.count("add_column") == text.count("drop_column") == 1
    assert f"sa.Column('{KEY}', sa.Double(), nullable=True)" in text


def test_rest_and_database_have_the_measure(extended: tuple[Service, str]) -> None:
    service, run_id = extended
    wanted = expected(service, run_id)
    run = service.get(f"/runs/{run_id}")
    assert [station[KEY] for station in run["stations"]] == pytest.approx(wanted)
    assert service.get(f"/runs?sort={KEY}:1")["runs"][0]["stations"]
    field = service.http.get("/openapi.json").json()["components"]["schemas"]["StationOut"]["properties"][KEY]
    assert (field["title"], field["unit"]) == (HEADING, "kN")
    assert KEY in [one["key"] for one in service.get("/schema")["measures"]]
    with sqlite3.connect(service.data / "rths.sqlite") as database:
        rows = database.execute(f"select {KEY} from run_station where {KEY} is not null order by run_number desc, number")
        assert [value for (value,) in rows.fetchall()[:2]] == pytest.approx(wanted)


def test_report_csv_and_recording_have_the_measure(extended: tuple[Service, str]) -> None:
    service, run_id = extended
    wanted = expected(service, run_id)
    report = service.http.get(f"/api/v1/runs/{run_id}/report.html").text
    assert HEADING in report and f"{wanted[0]:.3f}" in report
    rows = csv.DictReader(io.StringIO(service.http.get(f"/api/v1/runs/{run_id}/measures.csv").text))
    own = [row for row in rows if row["key"] == KEY]
    assert [float(row["value"]) for row in own] == pytest.approx(wanted)
    assert {row["unit"] for row in own} == {"kN"}
    with h5py.File(service.data / "recordings" / f"{run_id}.h5", "r") as file:
        assert KEY in file.attrs["summary"] and HEADING.partition(",")[0] in file.attrs["measures"]


def test_the_pages_show_the_measure(extended: tuple[Service, str], browser: Browser) -> None:
    service, run_id = extended
    wanted = expected(service, run_id)
    page = browser.new_page(base_url=service.url)
    visit(page, f"/runs/{run_id}")
    table = page.locator("#metrics table").first
    expect(table).to_contain_text(HEADING)
    expect(table).to_contain_text(f"{wanted[0]:.3f}")
    visit(page, "/runs")
    expect(page.locator("#heads")).to_contain_text(HEADING.partition(",")[0])
    expect(page.locator("#rows")).to_contain_text(f"{max(wanted, key=abs):#.3g}")
    page.close()


def test_a_running_test_shows_a_dash_for_a_measure_without_a_form_so_far(
    extended: tuple[Service, str], browser: Browser
) -> None:
    service, _ = extended
    run_id = service.submit(pace={"kind": "real_time", "factor": 1.0}, duration=40.0)
    service.wait(run_id, "running")
    page = browser.new_page(base_url=service.url)
    visit(page, f"/runs/{run_id}")
    tiles = page.locator(".tiles").first
    expect(tiles.locator("div", has_text="Peak stroke")).to_contain_text(".")
    expect(tiles.locator("div", has_text="Mean force")).to_contain_text("–")
    service.http.post(f"/api/v1/runs/{run_id}/cancel", json={})
    page.close()
