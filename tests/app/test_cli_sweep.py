"""`rths sweep`, as a person at a terminal and a program that reads its JSON see it."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import pytest
from arro3.io import read_parquet

from app.cli.main import main
from rths_engine.planning import templates
from rths_engine.planning.reading import plan_to_yaml

SWEEP = """
name: Delay
plan: plan.yaml
fields:
  - path: stations.*.compensator.alpha_es
    values: [20, 30]
  - path: structure.damping_ratio
    range: {from: 1 %, to: 5 %, count: 3}
"""


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    plan = templates.template("two-storeys").model_copy(update={"duration": 0.2})
    (tmp_path / "plan.yaml").write_text(plan_to_yaml(plan))
    (tmp_path / "delay.yaml").write_text(SWEEP)
    return tmp_path


def test_a_sweep_is_counted_without_being_executed(capsys: pytest.CaptureFixture[str], folder: Path) -> None:
    assert main(["sweep", "delay.yaml", "--count"]) == 0
    assert capsys.readouterr().out == "6 points: 6 of the fields (grid)\n"
    assert main(["sweep", "delay.yaml", "--count", "--json"]) == 0
    assert json.loads(capsys.readouterr().out) == {"points": 6, "notes": []}
    assert not list(folder.glob("*.csv"))


def test_a_sweep_is_executed_and_its_results_are_written(capsys: pytest.CaptureFixture[str], folder: Path) -> None:
    assert main(["sweep", "delay.yaml", "--processes", "1", "--out", "found.parquet", "--json"]) == 0
    found: dict[str, Any] = json.loads(capsys.readouterr().out)
    assert (found["points"], found["values"]["point"]) == (6, [1, 2, 3, 4, 5, 6])
    with (folder / "found.parquet").open("rb") as file:
        table = read_parquet(file).read_all()
    assert table["mte_mm.1"].to_pylist() == found["values"]["mte_mm.1"]
    assert sorted(path.name for path in folder.iterdir()) == ["delay.yaml", "found.parquet", "plan.yaml"]


def test_an_interrupted_sweep_keeps_its_points_and_resumes(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """32 points of a tenth of a second each in two processes; Ctrl-C comes after the first."""
    long = SWEEP.replace("plan.yaml", "two-storeys").replace("count: 3", "count: 16")
    (folder / "long.yaml").write_text(long)
    command = [sys.executable, "-m", "app.cli", "sweep", "long.yaml", "--processes", "2"]
    process = subprocess.Popen(
        command, stdout=subprocess.PIPE, text=True, env={**os.environ, "PYTHONPATH": str(Path(__file__).parents[2])}
    )
    partial = folder / "long.csv.partial"
    deadline = time.monotonic() + 120
    while not (partial.exists() and partial.read_text().count("\n") > 1):
        assert time.monotonic() < deadline and process.poll() is None
        time.sleep(0.05)
    process.send_signal(signal.SIGINT)
    said, _ = process.communicate(timeout=120)
    assert process.returncode == 130 and "the same command executes the other points" in said
    kept = (folder / "long.csv").read_text().splitlines()
    assert 2 <= len(kept) < 33
    with partial.open("a") as file:
        file.write('{"point": 15, "val')  # as a crash leaves it
    assert main(["sweep", "long.yaml", "--processes", "1"]) == 0
    whole = (folder / "long.csv").read_text().splitlines()
    assert len(whole) == 33 and set(kept) <= set(whole)  # with their computing times: not executed again
    assert not partial.exists()


@pytest.mark.parametrize(
    ("text", "more", "said"),
    [
        (SWEEP.replace("damping_ratio", "damping"), [], "fields.1.path = structure.damping: 'structure' of the kind"),
        (SWEEP.replace("plan.yaml", "nowhere.yaml"), [], "plan = nowhere.yaml: cannot be read"),
        (SWEEP + "records: [el-centro]\n", [], "records.0 = el-centro: no record has this name"),
        (SWEEP, ["--out", "found.xlsx"], "--out = found.xlsx: needs a name that ends with .csv, .parquet, .arrow"),
        ("[", [], "the text is not valid YAML"),
        ("4", [], "a sweep is a mapping"),
    ],
)
def test_what_cannot_be_executed_is_named(
    text: str, more: list[str], said: str, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (folder / "wrong.yaml").write_text(text)
    assert main(["sweep", "wrong.yaml", *more]) == 2
    assert said in capsys.readouterr().err


def test_the_points_of_another_sweep_are_not_continued(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (folder / "delay.csv.partial").write_text('{"schema": "rths-sweep-partial/1", "sweep": "", "code": ""}\n')
    assert main(["sweep", "delay.yaml"]) == 2
    assert "has the points of another sweep" in capsys.readouterr().err
