"""Reports, exports and text of each kind of test: what it measured, and nothing empty."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from app.cli.main import main
from app.runs.exports import csv_parts
from rths_engine.planning import templates
from rths_engine.planning.examples import EXAMPLES
from rths_engine.planning.model import Model
from rths_engine.planning.reading import plan_to_yaml
from rths_engine.recordings.run_file import Recording
from tests.app.test_reports import RUN, Page, recorded, report_html, shortened

WANTED = {
    "specimen-mr-damper": ["Drive", "Station 1: MR damper"],
    "actuator-sweep": ["Drive", "Station 1: Servo-hydraulic actuator"],
    "structure-earthquake": ["Ground motion", "Structure"],
    "structure-free-vibration": ["Start", "Structure"],
    "structure-matrices": ["Forces", "Structure"],
}


@pytest.fixture(scope="module")
def reports(tmp_path_factory: pytest.TempPathFactory) -> dict[str, tuple[Recording, Page]]:
    folder = tmp_path_factory.mktemp("reports")
    found = {}
    for name in WANTED:
        recording = recorded(folder, templates.template(name))
        found[name] = recording, Page(report_html(RUN, recording))
    return found


def headings(page: Page) -> list[str]:
    return [text for tag, text in page.texts if tag == "h2"]


@pytest.mark.parametrize("name", WANTED)
def test_a_report_has_the_sections_of_its_kind_of_test_and_no_empty_plot(
    name: str, reports: dict[str, tuple[Recording, Page]]
) -> None:
    _, page = reports[name]
    assert headings(page) == ["Results", "Notes", *WANTED[name], "Test plan", "Test record", "Repeating this test"]
    assert page.specs
    assert all(trace["x"]["bdata"] for spec in page.specs for trace in spec["traces"])


def test_the_report_of_a_semi_active_test_plots_its_current(tmp_path: Path) -> None:
    recording = recorded(tmp_path, shortened("semi-active"))
    assert any(spec["y"] == "Current, A" for spec in Page(report_html(RUN, recording)).specs)


def test_the_report_of_coupled_stations_tells_of_their_specimen(tmp_path: Path) -> None:
    page = Page(report_html(RUN, recorded(tmp_path, shortened("two-actuators"))))
    assert [text for tag, text in page.texts if tag == "h3" and text.startswith("Shared")] == [
        "Shared specimen: Bearing and damper"
    ]
    assert "Spacing of the actuators s" in page.text and "Law: Elastomeric (Maxwell chain)" in page.text
    assert "Bearing and damper on stations 1, 2" in page.text and "with None" not in page.text


def test_a_specimens_report_shows_its_loop_and_the_energy_it_dissipated(
    reports: dict[str, tuple[Recording, Page]],
) -> None:
    _, page = reports["specimen-mr-damper"]
    assert page.specs[0]["x"] == "Measured displacement, mm" and page.specs[0]["y"] == "Measured force, kN"
    assert any(spec["y"] == "Energy, kN·m" for spec in page.specs)
    assert "MTI" not in page.text and "Storey" not in page.text
    assert "50 mm (limit 80 mm)" in page.text


def test_the_energy_of_a_specimen_is_the_area_of_its_loops(reports: dict[str, tuple[Recording, Page]]) -> None:
    recording, page = reports["specimen-mr-damper"]
    x, force = recording.signal("x_meas.1"), recording.signal("f_meas.1")
    area = np.trapezoid(force, x) * 1e-3
    (said,) = [attrs["aria-label"] for _, attrs in page.tags if (attrs.get("aria-label") or "").startswith("Energy dissipated")]
    assert said is not None and float(said.split(" to ")[-1].split()[0]) == pytest.approx(area, rel=0.01)  # three digits


def test_an_actuators_report_shows_measured_against_commanded(reports: dict[str, tuple[Recording, Page]]) -> None:
    _, page = reports["actuator-sweep"]
    assert any(spec["x"] == "Command displacement, mm" and spec["y"] == "Measured displacement, mm" for spec in page.specs)
    assert "MTI" in page.text and "MEE" not in page.text


def test_a_free_vibration_tells_period_and_damping(reports: dict[str, tuple[Recording, Page]]) -> None:
    recording, page = reports["structure-free-vibration"]
    said = page.text.split("Period of the free decay ")[1]
    assert float(said.split()[0]) == pytest.approx(Model(recording.plan).periods[0], rel=0.005)  # dt = T1 / 55: omega dt^2 / 24
    assert float(page.text.split("Damping ratio ")[1].split()[0]) == pytest.approx(2.0, rel=0.05)


def test_given_matrices_are_printed_with_their_unit(reports: dict[str, tuple[Recording, Page]]) -> None:
    _, page = reports["structure-matrices"]
    assert "Stiffness matrix K, kN/m" in page.text
    assert "72000 −32000 0" in page.text


@pytest.mark.parametrize("name", [name for name in EXAMPLES if templates.template(name).test != "client"])
def test_the_command_line_runs_and_prints_every_kind(name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path, out = tmp_path / "plan.yaml", tmp_path / "rec.h5"
    plan: Any = templates.template(name).as_dict() | {"pace": {"kind": "fastest"}}
    path.write_text(json.dumps(plan))
    assert main(["run", str(path), "--out", str(out)]) == 0
    text = capsys.readouterr().out
    assert ("Peak stroke, mm" in text) == bool(plan["stations"])
    assert ("Floor peak, mm: floor 1" in text) == (plan["test"] in {"hybrid", "structure"})
    assert ("MEE" in text) == (plan["test"] == "hybrid")
    heading = next(csv_parts(out)).decode()
    assert ("ag (g)" in heading) == (plan["test"] in {"hybrid", "structure"})
    assert main(["stability", str(path)]) == 0
    assert ("no closed loop" in capsys.readouterr().out) == (plan["test"] in {"specimen", "actuator"})


def test_a_record_for_a_test_that_follows_its_drive_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "plan.yaml"
    path.write_text(plan_to_yaml(templates.template("specimen-mr-damper")))
    assert main(["run", str(path), "--record", "shake.at2"]) == 2
    assert "--record" in capsys.readouterr().err


def test_a_specimen_that_trips_is_reported_as_far_as_it_came(tmp_path: Path) -> None:
    plan = templates.template("specimen-mr-damper")
    (station,) = plan.stations
    weak = station.model_copy(update={"limits": station.limits.model_copy(update={"force": 1.6e5})})
    recording = recorded(tmp_path, plan.model_copy(update={"stations": (weak,)}))
    page = Page(report_html(RUN, recording))
    assert recording.status == "tripped" and 12.0 < recording.summary["simulated_s"] < 20.0  # in the second level
    assert "Tripped" in page.text and headings(page)[2] == "Drive"
