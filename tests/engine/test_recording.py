"""Recordings: complete or absent."""

from __future__ import annotations

from pathlib import Path

import h5py
import numpy as np
import pytest

from rths_engine.foundation import files
from rths_engine.foundation.errors import RecordingError
from rths_engine.planning import templates
from rths_engine.recordings import run_file as recording
from rths_engine.running.run import Run, simulate
from tests.engine.plans import LIBRARY

PLAN = templates.template("two-storeys").model_copy(update={"duration": 2.0})


def test_a_recording_gives_back_signals_plan_and_summary(tmp_path: Path) -> None:
    result = simulate(PLAN, LIBRARY)
    saved = recording.save(tmp_path / "run.h5", result)
    loaded = recording.load(tmp_path / "run.h5")
    assert np.array_equal(loaded.signals, result.signals)
    assert (loaded.plan, loaded.channels, loaded.summary) == (PLAN, result.channels, result.summary())
    assert saved.sha256 == files.checksum(tmp_path / "run.h5")
    assert saved.size == (tmp_path / "run.h5").stat().st_size
    assert [path.name for path in tmp_path.iterdir()] == ["run.h5"]


def test_a_run_stopped_before_its_first_substep_can_be_kept(tmp_path: Path) -> None:
    result = Run(PLAN, LIBRARY).result("cancelled", 0.0)
    recording.save(tmp_path / "run.h5", result)
    loaded = recording.load(tmp_path / "run.h5")
    assert loaded.signals.shape == (0, len(result.channels))
    assert loaded.summary["stations"][0]["mte_mm"] == 0.0


def test_a_failed_save_leaves_nothing_behind(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def broken(path: Path) -> None:
        raise OSError("disk full")

    monkeypatch.setattr(files, "sync", broken)
    with pytest.raises(OSError, match="disk full"):
        recording.save(tmp_path / "run.h5", simulate(PLAN, LIBRARY))
    assert list(tmp_path.iterdir()) == []


def test_a_damaged_or_foreign_file_is_named(tmp_path: Path) -> None:
    (tmp_path / "text.h5").write_text("hello")
    with h5py.File(tmp_path / "other.h5", "w") as file:
        file.attrs["schema"] = "something"
    recording.save(tmp_path / "cut.h5", simulate(PLAN, LIBRARY))
    (tmp_path / "cut.h5").write_bytes((tmp_path / "cut.h5").read_bytes()[:5000])
    for name in ("text.h5", "other.h5", "cut.h5", "absent.h5"):
        with pytest.raises(RecordingError, match=name):
            recording.load(tmp_path / name)
