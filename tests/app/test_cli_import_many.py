"""`rths import FOLDER_OR_ZIP`: recordings, a table and an exit code; the folder of measurements stays as it is."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
import pytest

from app.cli.main import main
from rths_engine.recordings import opening
from rths_engine.recordings.measured import Mapping, mapping_yaml
from tests.engine import batch_files as made


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "map.yaml").write_text(mapping_yaml.write(Mapping.read(made.mapping())), encoding="utf-8")
    (tmp_path / "tests.zip").write_bytes(made.zipped(made.fifty()))
    (tmp_path / "data").mkdir()
    for name, raw in made.fifty().items():
        (tmp_path / "data" / name).write_bytes(raw)
    return tmp_path


@pytest.mark.parametrize("source", ["tests.zip", "data"])
def test_fifty_files_become_recordings_with_a_table_of_what_differed(
    folder: Path, source: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["import", source, "--map", "map.yaml", "--out", "recordings", "--table", "table.csv"]) == 1
    told = capsys.readouterr().out
    assert "47 of 50 files imported; layout of most files: run00.csv" in told
    assert "    refused: line 92 = " in told and "    note: order of columns: Time (s), Force (kN), Disp (mm)" in told
    assert "run00.csv  imported       100         0         1.99      200" in told
    names = {f"{name.removesuffix('.csv')}.h5" for name in made.fifty()} - {"run11.h5", "run17.h5", "run31.h5"}
    assert {path.name for path in (folder / "recordings").iterdir()} == names
    np.testing.assert_allclose(
        opening.load(folder / "recordings" / "run08.h5").get("f_meas", 1), 1e3 * made.signals(8)["Force (kN)"], rtol=1e-8
    )
    with (folder / "table.csv").open(encoding="utf-8", newline="") as file:
        rows = {row["file"]: row for row in csv.DictReader(file)}
    assert len(rows) == 50 and rows["run08.csv"]["recording"] == "recordings/run08.h5"
    assert rows["run23.csv"]["differences"].startswith("sampling rate: 50 Hz; in the other files 100 Hz")
    assert (rows["run11.csv"]["result"], rows["run11.csv"]["recording"]) == ("refused", "")
    assert "does not have this column" in rows["run11.csv"]["reasons"]


def test_the_exit_code_says_whether_all_or_none_were_imported(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for name in ("run11.csv", "run17.csv", "run31.csv"):
        (folder / "data" / name).unlink()
    assert main(["import", "data", "--map", "map.yaml", "--out", "one"]) == 0
    (folder / "map.yaml").write_text((folder / "map.yaml").read_text().replace("Disp (mm)", "Travel"), encoding="utf-8")
    assert main(["import", "data", "--map", "map.yaml", "--out", "two"]) == 2
    assert "0 of 47 files imported" in capsys.readouterr().out
    assert list((folder / "two").iterdir()) == []


def test_names_of_folders_and_extensions_keep_recordings_apart_and_the_mapping_is_no_file_of_the_batch(folder: Path) -> None:
    (folder / "days" / "1").mkdir(parents=True)
    for name in ("1/a.csv", "1/a.txt", "b.csv"):
        (folder / "days" / name).write_bytes(made.file(1))
    (folder / "map.yaml").rename(folder / "days" / "map.yaml")
    assert main(["import", "days", "--map", "days/map.yaml", "--out", "out"]) == 0
    assert {path.name for path in (folder / "out").iterdir()} == {"1_a.csv.h5", "1_a.txt.h5", "b.h5"}


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (["data"], "many files need --map MAP.yaml and --out FOLDER"),
        (["data", "--guess"], "many files need --map MAP.yaml and --out FOLDER"),
        (["data", "--map", "none.yaml", "--out", "out"], "--map = none.yaml: cannot be read"),
        (["data", "--map", "map.yaml", "--out", "data/out"], "needs a folder outside the folder of measurements"),
        (["data", "--map", "map.yaml", "--out", "map.yaml"], "--out = map.yaml"),
        (["data", "--map", "map.yaml", "--out", "none/out"], "there is no folder none"),
        (["data", "--map", "map.yaml", "--out", "out", "--table", "none/table.csv"], "there is no folder none"),
        (["none.zip", "--map", "map.yaml", "--out", "out"], "cannot be read: No such file"),
        (["bad.zip", "--map", "map.yaml", "--out", "out"], "bad.zip: is not a complete ZIP archive"),
        (["out.zip", "--map", "map.yaml", "--out", "out"], "leads out of the archive"),
        (["empty", "--map", "map.yaml", "--out", "out"], "contains no file"),
        (["two", "--map", "map.yaml", "--out", "out"], "would give two recordings of one name"),
        (["data/run01.csv", "--map", "map.yaml", "--out", "a.h5", "--table", "t.csv"], "need a folder or a .zip of files"),
    ],
)
def test_what_cant_be_used_exits_2_with_the_reason_and_leaves_nothing(
    folder: Path, arguments: list[str], told: str, capsys: pytest.CaptureFixture[str]
) -> None:
    (folder / "bad.zip").write_bytes(b"1,2\n")
    (folder / "out.zip").write_bytes(made.zipped({"../../run.csv": made.file(1)}))
    (folder / "empty").mkdir()
    (folder / "two" / "a").mkdir(parents=True)
    for name in ("a/b.csv", "a_b.csv"):
        (folder / "two" / name).write_bytes(made.file(1))
    (folder / "two" / "a" / "b.txt").write_bytes(made.file(1))
    before = sorted(folder.rglob("*"))
    assert main(["import", *arguments]) == 2
    assert told in capsys.readouterr().err
    assert sorted(folder.rglob("*")) == before
