"""`rths import`: a proposed mapping imports the file it was proposed for; what can't be used leaves nothing behind."""

from __future__ import annotations

import hashlib
from pathlib import Path

import numpy as np
import pytest

from app.cli.main import main
from rths_engine.recordings import measured, opening
from tests.engine.measurements import COLUMNS, F, csv, text


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "sine.csv").write_bytes(csv())
    return tmp_path


def test_the_proposed_mapping_imports_its_file(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["import", "sine.csv", "--guess"]) == 0
    (folder / "map.yaml").write_text(capsys.readouterr().out, encoding="utf-8")
    assert main(["import", "sine.csv", "--map", "map.yaml", "--out", "rec.h5"]) == 0
    told = capsys.readouterr()
    assert "rec.h5: 1001 samples at 200 Hz, 5 s" in told.out and "f_meas.1" in told.out and told.err == ""
    found = opening.load(folder / "rec.h5")
    np.testing.assert_allclose(found.get("f_meas", 1), 1e3 * F, rtol=1e-8, atol=1e-4)  # nine digits were written
    assert found.source == str(folder / "sine.csv")
    assert found.source_sha256 == hashlib.sha256(csv()).hexdigest()


def test_a_proposal_with_an_unstated_unit_is_refused_until_the_unit_is_chosen(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (folder / "bare.csv").write_bytes(text(head=("t (s),disp (mm),vel (mm/s),Kraft",)))
    assert main(["import", "bare.csv", "--guess"]) == 0
    proposed = capsys.readouterr().out
    assert "unit: ''" in proposed and "a guess by its name alone; the file states no unit: choose it; kN would fit" in proposed
    (folder / "map.yaml").write_text(proposed, encoding="utf-8")
    assert main(["import", "bare.csv", "--map", "map.yaml", "--out", "rec.h5"]) == 2
    told = capsys.readouterr().err
    assert "mapping.channels.3.unit: the unit of column 'Kraft' is not stated: choose the unit" in told
    assert "choose one of N, kN, MN, mN, daN, kgf, tf, tonf(US), lb, lbf, kip" in told
    (folder / "map.yaml").write_text(proposed.replace("unit: ''", "unit: kN"), encoding="utf-8")
    assert main(["import", "bare.csv", "--map", "map.yaml", "--out", "rec.h5"]) == 0


def test_columns_that_are_not_recognised_are_listed_to_complete(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    rows = "".join(f"{np.sin(k / 9):.4f},{np.cos(k / 7):.4f}\n" for k in range(100))
    (folder / "odd.csv").write_text(f"CHANNEL0,CHANNEL1\n{rows}", encoding="utf-8")
    assert main(["import", "odd.csv", "--guess"]) == 0
    told = capsys.readouterr()
    assert '# - column: "CHANNEL0"  # 100 values' in told.out and "#   role: ?" in told.out and "# rate: ?" in told.out
    assert "no column is recognised as a measurement" in told.err
    done = told.out.replace("# rate: ?", "rate: 250").replace("# - column", "- column").replace("#   ", "  ")
    for role, unit in (("x_meas", "mm"), ("f_meas", "kN")):
        done = done.replace("role: ?", f"role: {role}", 1).replace("unit: ?", f"unit: {unit}", 1)
    (folder / "map.yaml").write_text(done, encoding="utf-8")
    assert main(["import", "odd.csv", "--map", "map.yaml", "--out", "rec.h5"]) == 0
    assert "100 samples at 250 Hz" in capsys.readouterr().out


def test_the_programs_own_recording_needs_no_unit_and_no_step(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (folder / "map.yaml").write_text(_mapping(), encoding="utf-8")
    assert main(["import", "sine.csv", "--map", "map.yaml", "--out", "rec.h5"]) == 0
    capsys.readouterr()
    assert main(["import", "rec.h5", "--guess"]) == 0
    (folder / "again.yaml").write_text(capsys.readouterr().out, encoding="utf-8")
    assert main(["import", "rec.h5", "--map", "again.yaml", "--out", "again.h5"]) == 0
    found = opening.load(folder / "again.h5")
    np.testing.assert_array_equal(found.get("f_meas", 1), opening.load(folder / "rec.h5").get("f_meas", 1))


def test_warnings_are_told_and_kept(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    columns = COLUMNS.copy()
    columns[:, 3] = 1.0
    (folder / "sine.csv").write_bytes(csv(columns))
    (folder / "map.yaml").write_text(_mapping(), encoding="utf-8")
    assert main(["import", "sine.csv", "--map", "map.yaml", "--out", "rec.h5"]) == 0
    assert "warning: f_meas.1 at 0 s = 1 kN throughout: is constant" in capsys.readouterr().err
    assert [warning.channel for warning in opening.load(folder / "rec.h5").warnings] == ["f_meas.1"]


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (["none.csv", "--guess"], "FILE = none.csv: cannot be read: No such file"),
        (["sine.csv"], "needs either --guess, or --map MAP.yaml and --out REC.h5"),
        (["sine.csv", "--map", "map.yaml"], "needs either --guess"),
        (["sine.csv", "--guess", "--out", "rec.h5"], "needs either --guess"),
        (["sine.csv", "--map", "none.yaml", "--out", "rec.h5"], "--map = none.yaml: cannot be read"),
        (["sine.csv", "--map", "sine.csv", "--out", "rec.h5"], "mapping"),
        (["sine.csv", "--map", "broken.yaml", "--out", "rec.h5"], "line 2: the text is not valid YAML"),
        (["sine.csv", "--map", "map.yaml", "--out", "missing/rec.h5"], "there is no folder missing"),
        (["sine.csv", "--map", "map.yaml", "--out", "sine.csv"], "is the file of measurements itself"),
        (["backwards.csv", "--map", "map.yaml", "--out", "rec.h5"], "time does not increase at sample 11"),
        (["other.csv", "--map", "map.yaml", "--out", "rec.h5"], "the file does not have this column (it has Force)"),
    ],
)
def test_what_cant_be_used_exits_2_with_the_reason_and_leaves_nothing(
    folder: Path, arguments: list[str], told: str, capsys: pytest.CaptureFixture[str]
) -> None:
    columns = COLUMNS.copy()
    columns[10, 0] = columns[9, 0]
    (folder / "backwards.csv").write_bytes(csv(columns))
    (folder / "other.csv").write_text("t,Force\n0,1\n1,2\n2,1\n3,2\n")
    (folder / "map.yaml").write_text(_mapping(), encoding="utf-8")
    (folder / "broken.yaml").write_text("channels: [", encoding="utf-8")
    before = {path.name: path.read_bytes() for path in folder.iterdir()}
    assert main(["import", *arguments]) == 2
    assert told in capsys.readouterr().err
    assert {path.name: path.read_bytes() for path in folder.iterdir()} == before


def _mapping() -> str:
    from rths_engine.recordings.measured import mapping_yaml
    from tests.engine.measurements import mapping

    return mapping_yaml.write(measured.Mapping.read(mapping()))
