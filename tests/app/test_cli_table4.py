"""`rths table4` at a terminal and for programs."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from app.cli.main import main
from tests.app.test_cli import STATION


@pytest.fixture
def record(tmp_path: Path) -> Path:
    """A bare record: two cycles of 1 Hz and 0.3 g, and nothing of step or unit."""
    path = tmp_path / "record.txt"
    samples = 0.3 * np.sin(2 * np.pi * np.arange(101) * 0.02)
    path.write_text("\n".join(f"{value:.6e}" for value in samples))
    return path


def test_the_twelve_are_printed_beside_the_papers_and_written_as_json(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "table.json"
    assert main(["table4", "--json", str(out)]) == 0
    printed = capsys.readouterr().out
    assert "2.0 / 3.2" in printed and "Outcomes as in the paper" in printed
    found = json.loads(out.read_text())
    assert set(found) == {"rows", "floors_peak_mm", "drifts_percent"}
    assert [row["simulation"] for row in found["rows"]] == list(range(1, 13))
    assert all(set(row) == {"simulation", "status", "trip_s", "stations"} for row in found["rows"])
    assert all(set(station) >= STATION for row in found["rows"] for station in row["stations"])
    tripped = [row["trip_s"] is not None for row in found["rows"]]
    assert tripped == [row["status"] == "tripped" for row in found["rows"]]
    assert len(found["floors_peak_mm"]) == len(found["drifts_percent"]) == 2


def test_a_bare_file_is_read_as_the_papers_record_is_unless_told(record: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["table4", "--record", str(record), "--factor", "0.1"]) == 0
    assert "101 values every 0.02 s, scaled by 0.1, scaled peak 0.030 g" in capsys.readouterr().out
    told = ["--record-dt", "0.01", "--record-unit", "m/s^2", "--factor", "0.5"]
    assert main(["table4", "--record", str(record), *told]) == 0
    assert "101 values every 0.01 s, scaled by 0.5, scaled peak 0.015 g" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (["--record", "nowhere.txt"], "cannot be read"),
        (["--record-dt", "0.01"], "name the record's file"),
        (["--factor", "-1"], "factor"),
        (["--factor", "nan"], "factor"),
        (["--json", "no/such/folder/out.json"], "there is no folder"),
    ],
)
def test_what_cannot_be_used_is_named(arguments: list[str], told: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["table4", *arguments]) == 2
    assert told in capsys.readouterr().err
