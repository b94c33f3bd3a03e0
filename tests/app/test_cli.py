"""The command line, as a person at a terminal and a program that reads its JSON see it."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import h5py
import pytest
from ruamel.yaml import YAML

from app.cli.main import main
from rths_engine.planning import templates
from rths_engine.planning.reading import plan_from_yaml
from rths_engine.recordings.run_file import load
from rths_engine.running.run import simulate

STATION = {
    *("name", "mte_mm", "rms_percent", "mti_mm2", "mee_kNm", "peak_stroke_mm", "peak_force_kN"),
    *("fei_delay_ms", "fei_amplitude", "nrms_percent", "peak_error_percent", "delay_ms", "energy_error_percent"),
    *("reference_rms_percent", "reference_peak_percent"),
}
SUMMARY = {
    *("status", "trip", "elapsed_s", "simulated_s", "stations", "floors_peak_mm", "input_energy_kNm"),
    *("floors_reference_rms_percent", "floors_reference_peak_percent"),
}
Write = Callable[..., Path]


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def write(folder: Path) -> Write:
    """Write 1 s of the template of two storeys, with some of it changed by dotted paths."""

    def written(**changes: Any) -> Path:
        data = {**templates.template("two-storeys").as_dict(), "duration": 1.0}
        for path, value in changes.items():
            *parents, last = path.split("__")
            part: Any = data
            for name in parents:
                part = part[int(name) if name.isdigit() else name]
            part[last] = value
        file = folder / "plan.yaml"
        with file.open("w") as stream:
            YAML().dump(data, stream)
        return file

    return written


def printed(capsys: pytest.CaptureFixture[str]) -> dict[str, Any]:
    """The one JSON object on standard output."""
    found: dict[str, Any] = json.loads(capsys.readouterr().out)
    return found


def test_without_a_name_every_template_is_listed(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["plan"]) == 0
    assert [line.split()[0] for line in capsys.readouterr().out.splitlines()] == templates.names()


@pytest.mark.parametrize("name", templates.names())
def test_a_printed_template_reads_back_as_the_same_plan(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["plan", name]) == 0
    assert plan_from_yaml(capsys.readouterr().out) == templates.template(name)


def test_an_unknown_template_is_refused_with_the_names_there_are(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["plan", "table3-13"]) == 2
    out, err = capsys.readouterr()
    assert not out and "the template 'table3-13' does not exist" in err and "table3-12" in err


def test_json_is_one_object_with_the_measures_of_the_run(write: Write, capsys: pytest.CaptureFixture[str]) -> None:
    plan = write()
    assert main(["run", str(plan), "--json"]) == 0
    found = printed(capsys)
    assert found.keys() == SUMMARY and all(station.keys() == STATION for station in found["stations"])
    expected = simulate(plan_from_yaml(plan.read_text())).summary()
    assert {**found, "elapsed_s": 0} == {**expected, "elapsed_s": 0}


def test_the_table_names_units_and_the_papers_measures(write: Write, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["run", str(write(template="table3-04"))]) == 0
    out = capsys.readouterr().out
    for heading in ("MTE, mm", "RMS, %", "MTI, mm²", "MEE, kN·m", "Peak stroke, mm", "Peak force, kN"):
        assert heading in out
    rows = [line.split()[1:] for line in out.splitlines() if line.startswith("  paper")]
    assert rows == [["0.8", "1.4", "11.8", "-2.6", "–", "–"], ["1.6", "2", "48.1", "-2.3", "–", "–"]]


def test_a_tripped_run_is_a_run_that_was_made(write: Write, capsys: pytest.CaptureFixture[str]) -> None:
    plan = write(stations__0__limits__displacement="0.01 mm")
    assert main(["run", str(plan), "--json"]) == 0
    found = printed(capsys)
    assert found["status"] == "tripped" and found["simulated_s"] < 1.0
    assert found["trip"]["station"] == 1 and "0.01 mm" in found["trip"]["sentence"]
    assert main(["run", str(plan)]) == 0
    assert found["trip"]["sentence"] in capsys.readouterr().out


def test_out_is_a_recording_of_the_plan(write: Write, folder: Path) -> None:
    plan = write()
    assert main(["run", str(plan), "--out", str(folder / "rec.h5")]) == 0
    recording = load(folder / "rec.h5")
    assert recording.plan == plan_from_yaml(plan.read_text())
    assert (recording.signals == simulate(recording.plan).signals).all()


@pytest.mark.parametrize(("out", "problem"), [("missing/rec.h5", "there is no folder missing"), (".", "is a folder")])
def test_an_out_that_cannot_be_written_is_refused_before_the_run(
    out: str, problem: str, write: Write, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("app.cli.run.advance", lambda *_: pytest.fail("the test was run"))
    assert main(["run", str(write()), "--out", out]) == 2
    captured = capsys.readouterr()
    assert problem in captured.err and not captured.out


def test_a_recording_that_cannot_be_stored_leaves_the_old_one(
    write: Write, folder: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(*_: Any) -> None:
        raise OSError(28, "No space left on device")

    (folder / "rec.h5").write_text("an older recording")
    monkeypatch.setattr(h5py, "File", full)
    assert main(["run", str(write()), "--out", "rec.h5", "--json"]) == 1
    found = printed(capsys)
    assert found["status"] == "failed" and "No space left" in found["errors"][0]["problem"]
    assert (folder / "rec.h5").read_text() == "an older recording"
    assert sorted(path.name for path in folder.iterdir()) == ["plan.yaml", "rec.h5"]


@pytest.mark.parametrize(
    ("changes", "where"),
    [
        ({"structure__storeys__0__mass": -1.0}, "structure.storeys.0.mass"),
        ({"stations__1__actuator__alpha": 0.5}, "stations.1.actuator.alpha"),
        ({"motion__record": "el-centro"}, "motion.record"),
        ({"integrator__dt": 0.01}, "integrator.dt"),
        ({"seed": float("nan")}, "seed"),
        ({"motion": {"kind": "inline", "dt": 0.01, "acceleration": [0.0, float("nan")]}}, "motion.acceleration.1"),
        ({"motion": {"kind": "file", "path": "nowhere.at2"}}, "motion.path"),
        ({"stations__0__dampers": 0, "structure__damping_ratio": 2.0}, "stations.0.dampers"),
    ],
)
def test_a_plan_with_mistakes_is_refused_with_one_line_for_each(
    changes: dict[str, Any], where: str, write: Write, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["run", str(write(**changes)), "--out", "rec.h5", "--json"]) == 2
    captured = capsys.readouterr()
    found = json.loads(captured.out)
    assert found["status"] == "failed" and where in [error["where"] for error in found["errors"]]
    assert len(captured.err.splitlines()) == len(found["errors"]) == len(changes)
    assert all(line.startswith("rths run: ") for line in captured.err.splitlines())
    assert not (folder / "rec.h5").exists()


@pytest.mark.parametrize(
    ("raw", "problem"),
    [
        (None, "No such file"),
        (b"", "a mapping of fields"),
        (b"name: [", "not valid YAML"),
        (b"\x89HDF\r\n\xff", "is not valid UTF-8 text"),
        (b"- 1\n- 2\n", "a mapping of fields"),
    ],
)
def test_a_file_that_is_no_plan_is_refused(
    raw: bytes | None, problem: str, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    if raw is not None:
        (folder / "plan.yaml").write_bytes(raw)
    assert main(["run", "plan.yaml"]) == 2
    captured = capsys.readouterr()
    assert problem in captured.err and not captured.out


def test_two_gigabytes_are_refused_unread(write: Write, folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    huge = folder / "huge.AT2"
    huge.touch()
    os.truncate(huge, 2 << 30)
    assert main(["run", str(write()), "--record", str(huge)]) == 2
    assert "file = 2147483648: is larger than 100,000,000 bytes" in capsys.readouterr().err
    assert main(["run", str(huge)]) == 2
    assert "the plan has more than 20,000,000 characters" in capsys.readouterr().err
    assert sorted(path.name for path in folder.iterdir()) == ["huge.AT2", "plan.yaml"]


@pytest.fixture
def columns(folder: Path) -> Path:
    """A record of one column: a pulse of 2 m/s^2 for 0.2 s."""
    file = folder / "records" / "pulse.txt"
    file.parent.mkdir()
    file.write_text("\n".join(["0.0"] * 10 + ["2.0"] * 20 + ["0.0"] * 70))
    return file


def peak_acceleration(path: Path) -> float:
    return float(abs(load(path).signal("ag")).max())


def test_record_replaces_the_plans_motion_and_keeps_its_scale(write: Write, columns: Path, folder: Path) -> None:
    given = ["--record", str(columns), "--record-unit", "m/s^2", "--record-dt", "10 ms"]
    assert main(["run", str(write(motion__scale={"kind": "factor", "factor": 0.5})), *given, "--out", "rec.h5"]) == 0
    assert peak_acceleration(folder / "rec.h5") == 1.0  # the factor is a power of two: no rounding


def test_a_record_file_in_a_plan_lies_beside_the_plan(
    write: Write, columns: Path, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    plan = write(motion={"kind": "file", "path": "records/pulse.txt", "unit": "m/s^2", "dt": 0.01})
    monkeypatch.chdir(columns.parent)
    assert main(["run", str(plan), "--out", str(folder / "rec.h5")]) == 0
    assert peak_acceleration(folder / "rec.h5") == 2.0


def test_a_records_unit_without_a_record_is_refused(write: Write, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["run", str(write()), "--record-unit", "g"]) == 2
    assert "--record" in capsys.readouterr().err


def test_motions_lists_every_record_with_its_peak(capsys: pytest.CaptureFixture[str]) -> None:
    from rths_engine.parts.ground_motions import MotionLibrary

    assert main(["motions"]) == 0
    heading, *rows = capsys.readouterr().out.splitlines()
    assert "PGA, g" in heading and [row.split()[0] for row in rows] == MotionLibrary(None).names()


def test_a_reader_that_stops_early_gets_no_traceback() -> None:
    reading, writing = os.pipe()
    os.close(reading)
    command = [sys.executable, "-u", "-m", "app.cli", "plan"]
    made = subprocess.run(command, stdout=writing, stderr=subprocess.PIPE, text=True, check=False)
    os.close(writing)
    assert made.returncode == 0 and not made.stderr


def test_help_imports_none_of_the_engine_and_the_service() -> None:
    code = "import sys, app.cli.main; app.cli.main.parser().format_help(); print(*sys.modules)"
    loaded = set(subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.split())
    assert not loaded & {"numpy", "numba", "pydantic", "fastapi", "sqlalchemy", "dbos"}
