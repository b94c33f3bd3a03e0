"""`rths diagnose`: a recording whose specimen holds more than its plan, and what can't be diagnosed."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import pytest

from app.cli.main import main
from rths_engine.parts.ground_motions import MotionLibrary
from rths_engine.planning.plan import Plan
from rths_engine.planning.reading import plan_to_yaml, read_plan
from rths_engine.recordings import run_file as recording
from rths_engine.running.run import simulate


def plan(**more: Any) -> Plan:
    station = {
        "compensator": {"kind": "none"},
        "actuator": {"kind": "first_order_delay", "alpha": 4},
        "specimen": {"kind": "linear", "stiffness": 2.0e6, "damping": 8.0e5},
        "noise": {"displacement": 1e-5, "force": 1500.0},
        **more,
    }
    shape = {"kind": "band_noise", "low_frequency": 0.1, "high_frequency": 2.0, "duration": 12.0}
    drive = {"amplitude": 0.03, "shape": shape}
    return read_plan({"test": "specimen", "controller_rate": 512.0, "drive": drive, "stations": [station], "seed": 3})


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    made = tmp_path_factory.mktemp("diagnosis")
    (made / "plan.yaml").write_text(plan_to_yaml(plan()), encoding="utf-8")
    left_out = [{"kind": "backlash", "gap": 0.002}]
    recording.save(made / "played.h5", simulate(plan(specimen_physics=left_out), MotionLibrary(None)))
    recording.save(made / "clean.h5", simulate(plan(), MotionLibrary(None)))
    return made


def test_concealed_backlash_is_named_with_its_size_and_proved_on_what_was_not_fitted(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = folder / "out.json"
    assert main(["diagnose", str(folder / "plan.yaml"), str(folder / "played.h5"), "--json", str(out)]) == 0
    found = json.loads(out.read_text())
    assert found["schema"] == "rths-diagnosis/1"
    assert found["verdict"] == "mismatch"
    assert [(one["component"], one["id"]) for one in found["effects"]] == [("specimen:1", "backlash")]
    gap = found["effects"][0]["parameters"][0]
    assert gap["value"] == pytest.approx(0.002, rel=0.05)
    assert gap["ci90"][0] < gap["value"] < gap["ci90"][1] and gap["unit"] == "m"
    assert "2 mm" in found["effects"][0]["sentence"] and "backlash was left out" in found["effects"][0]["sentence"]
    fit = found["fit"]
    assert fit["extended"]["heldout_nrmse"] < 0.5 * fit["baseline"]["heldout_nrmse"]
    assert sum(one["probability"] for one in found["candidates"]) <= 1 + 1e-9
    assert "backlash was left out" in capsys.readouterr().out
    extended = read_plan(found["extended_plan"])
    assert extended.stations[0].specimen_physics[0].id == "backlash"


def test_a_clean_recording_is_not_accused(folder: Path) -> None:
    out = folder / "clean.json"
    assert main(["diagnose", str(folder / "plan.yaml"), str(folder / "clean.h5"), "--json", str(out)]) == 0
    found = json.loads(out.read_text())
    assert found["verdict"] in ("consistent", "recalibrate")  # the smoothing of the displacement may move c a little
    assert found["effects"] == [] and found["extended_plan"] is None


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (["plan.yaml", "none.h5"], "the recording none.h5 does not exist"),
        (["plan.yaml", "plan.yaml"], "plan.yaml is not a complete recording"),
        (["two.yaml", "clean.h5"], "is of a 'specimen' test; the plan describes a 'hybrid' test"),
        (["slow.yaml", "clean.h5"], "clean.h5: has a sampling rate of 512 Hz; the controller rate of the plan is 256 Hz"),
        (["plan.yaml", "clean.h5", "--holdout", "slow.h5"], "--holdout slow.h5: has a sampling rate of 256 Hz"),
        (["plan.yaml", "clean.h5", "--with", "clean.h5", "slow.h5"], "--with slow.h5: has a sampling rate of 256 Hz"),
        (["plan.yaml", "clean.h5", "--level", "2"], "needs a false-alarm rate between 0 and 1"),
        (["plan.yaml", "clean.h5", "--json", "missing/out.json"], "there is no folder missing"),
    ],
)
def test_what_cant_be_diagnosed_is_refused_with_the_reason(
    folder: Path, arguments: list[str], told: str, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(folder)
    slow = plan().model_copy(update={"controller_rate": 256.0})
    (folder / "slow.yaml").write_text(plan_to_yaml(slow), encoding="utf-8")
    if not (folder / "slow.h5").exists():
        recording.save(folder / "slow.h5", simulate(slow, MotionLibrary(None)))
    first = plan().stations[0].model_dump()
    building = {"kind": "shear_building", "storeys": [{"mass": 1e6, "stiffness": 1e8}]}
    two = {"structure": building, "duration": 1.0, "stations": [{**first, "name": name} for name in ("A", "B")]}
    (folder / "two.yaml").write_text(plan_to_yaml(read_plan(two)), encoding="utf-8")
    assert main(["diagnose", *arguments]) == 2
    assert told in capsys.readouterr().err
    assert not list(folder.glob(".*.tmp"))


def test_the_report_is_one_file_with_the_verdict_its_tables_and_its_plots(folder: Path) -> None:
    out = folder / "report.html"
    assert main(["diagnose", str(folder / "plan.yaml"), str(folder / "played.h5"), "--report", str(out)]) == 0
    html = out.read_text(encoding="utf-8")
    assert not re.search(r"<(script|link|img)[^>]+(src|href)=\"(?!data:)", html)
    assert "<script" not in html and len(html.encode()) < 1e6
    assert "backlash was left out" in html.partition("<main>")[0]
    for heading in ("Where recording and simulation differ", "Left-out physics", "Proof on held-out data"):
        assert heading in html
    drawn = re.findall(r"<svg .*?</svg>", html, re.DOTALL)
    assert all(name in drawn[0] for name in ("Actuator", "of Station", "Specimen"))
    assert all(name in drawn[1] for name in ("Recording", "Planned model", "Extended model"))
    assert drawn[1].count('class="sh"') == 3
    paper = folder / "report.pdf"
    assert main(["diagnose", str(folder / "plan.yaml"), str(folder / "played.h5"), "--report", str(paper)]) == 0
    assert paper.read_bytes().startswith(b"%PDF-")
    assert main(["diagnose", str(folder / "plan.yaml"), str(folder / "played.h5"), "--report", str(folder / "a.doc")]) == 2
