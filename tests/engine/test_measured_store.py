"""Gain, sign, rates and trim come out as the mapping says; a recording is kept whole; a run's recording is one as well."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest

from rths_engine.formats.table import Column, Table
from rths_engine.foundation.errors import MeasuredError, RecordingError
from rths_engine.parts.ground_motions import MotionLibrary
from rths_engine.planning.templates import template
from rths_engine.recordings import run_file as recording
from rths_engine.recordings.measured import Mapping, Measured, examine, imported, save
from rths_engine.recordings.opening import load
from rths_engine.running.run import simulate
from tests.engine.measurements import COLUMNS, NAMES, RATE, X, mapping


def table(*columns: Column) -> Table:
    return Table("test", columns or tuple(Column(name, values) for name, values in zip(NAMES, COLUMNS.T, strict=True)))


def one(values: np.ndarray, **more: Any) -> np.ndarray:
    given = {"column": "x", "role": "x_meas", "unit": "mm", **more}
    found = imported(table(Column("x", values, dt=1 / RATE)), Mapping.read({"channels": [given]}))
    return np.asarray(found.channels[0].values)


def test_value_is_sign_times_gain_times_column_less_offset() -> None:
    np.testing.assert_allclose(one(X, unit="V", gain="2.5 mm/V", offset=4.0, reverse=True), -2.5e-3 * (X - 4.0), rtol=1e-12)
    np.testing.assert_allclose(one(X, gain=1.02), 1.02e-3 * X, rtol=1e-12)
    np.testing.assert_allclose(one(X, role="temperature", unit="degC"), X + 273.15, rtol=1e-12)
    np.testing.assert_allclose(one(X, role="f_meas", unit="kip"), 4448.2216152605 * X, rtol=1e-12)


def test_a_lower_rate_keeps_the_motion_and_takes_away_what_would_fold_into_it() -> None:
    t = np.arange(20_000) / 1000
    slow, fast = np.sin(2 * np.pi * 2.0 * t), np.sin(2 * np.pi * 98.0 * t)  # 98 Hz would appear at 2 Hz when 1 in 10 is taken
    given = {"channels": [{"column": "x", "role": "x_meas", "unit": "m"}], "rate": 1000, "target_rate": 100}
    found = imported(table(Column("x", slow + fast)), Mapping.read(given)).get("x_meas", 1)
    inner = slice(50, -50)  # the filter's ends, 10 samples of the lower rate on either side, and some more
    # resample_poly's window lets 0.1 % through here; taking every tenth sample would leave an error of 1
    np.testing.assert_allclose(found[inner], slow[::10][: len(found)][inner], atol=5e-3)


def test_a_rate_in_no_simple_ratio_is_reached_in_phase() -> None:
    found = imported(table(), Mapping.read(mapping(target_rate=1024)))
    assert found.dt == 1 / 1024
    truth = 0.025 * np.sin(2 * np.pi * 0.8 * found.time)
    inner = slice(200, -200)  # the filter's ends: 10 samples of 200 Hz are 51 of 1024 Hz
    np.testing.assert_allclose(found.get("x_meas", 1)[inner], truth[inner], atol=5e-5)  # 0.2 %, the filter's ripple


def test_channels_of_different_clocks_share_one_step_and_what_all_measured() -> None:
    fast, slow = np.arange(4001) / 800, 0.25 + np.arange(501) / 100
    signals = (Column("tx (s)", fast), Column("x", np.sin(fast)), Column("tf (s)", slow), Column("f", np.sin(slow)))
    channels = [
        {"column": "x", "role": "x_meas", "unit": "m", "time": "tx (s)"},
        {"column": "f", "role": "f_meas", "unit": "N", "time": "tf (s)"},
    ]
    found = imported(table(*signals), Mapping.read({"channels": channels}))
    assert found.dt == 1 / 800 and found.start == pytest.approx(0.25)
    inner = slice(100, -100)  # the ends of the filter by which f goes from 100 to 800 Hz
    np.testing.assert_allclose(found.get("f_meas", 1)[inner], found.get("x_meas", 1)[inner], atol=2e-3)  # its ripple
    assert [warning.channel for warning in found.warnings] == ["x_meas.1", "f_meas.1"]


def test_start_and_stop_are_in_the_files_time() -> None:
    found = imported(table(), Mapping.read(mapping(start=1.0, stop=3.0)))
    assert found.start == pytest.approx(1.0) and found.samples == 401
    np.testing.assert_allclose(found.get("x_meas", 1), 1e-3 * X[200:601], rtol=1e-12)


@pytest.mark.parametrize(
    ("more", "told"),
    [
        ({"start": 7.0}, "leave 0 samples"),
        ({"target_rate": 0.1}, "leave 1 samples"),
        ({"target_rate": 0.4}, "leave 3 samples"),
        ({"target_rate": 1e6}, "at most 1000"),
    ],
)
def test_a_cut_or_rate_that_leaves_nothing_to_work_with_is_refused(more: dict[str, Any], told: str) -> None:
    with pytest.raises(MeasuredError) as refusal:
        examine(table(), Mapping.read(mapping(**more)))
    assert told in str(refusal.value)


def test_without_any_step_the_import_asks_for_it() -> None:
    with pytest.raises(MeasuredError, match="neither the file nor the mapping states the time step"):
        examine(table(Column("x", X)), Mapping.read({"channels": [{"column": "x", "role": "x_meas", "unit": "mm"}]}))


def test_a_recording_comes_back_as_it_was_kept(tmp_path: Path) -> None:
    clipped = COLUMNS.copy()
    clipped[:, 3] = np.minimum(clipped[:, 3], 8.0)
    given = table(*(Column(name, values) for name, values in zip(NAMES, clipped.T, strict=True)))
    kept = imported(given, Mapping.read(mapping(title="sine", test="specimen", start=0.5)), "sine.csv", "ab" * 32)
    save(tmp_path / "rec.h5", kept)
    found = load(tmp_path / "rec.h5")
    assert (found.dt, found.start, found.title, found.test, found.source, found.source_sha256) == (
        kept.dt, kept.start, "sine", "specimen", "sine.csv", "ab" * 32,
    )  # fmt: skip
    assert found.warnings == kept.warnings != ()
    assert Mapping.from_yaml(found.mapping) == Mapping.read(mapping(title="sine", test="specimen", start=0.5))
    assert set(found.keys) == {"x_meas.1", "v_meas.1", "f_meas.1"}
    for channel in kept.channels:
        np.testing.assert_array_equal(found.get(channel.role, channel.number), channel.values)
    with h5py.File(tmp_path / "rec.h5") as file:
        assert file.attrs["schema"] == "rths-measured/1" and file["f_meas.1"].attrs["unit"] == "N"
        assert dict(file["x_meas.1"].attrs)["column"] == "Disp (mm)"


def test_nothing_half_written_is_left_behind(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("rths_engine.recordings.measured.store._write", lambda *_: (_ for _ in ()).throw(OSError("disk full")))
    with pytest.raises(OSError, match="disk full"):
        save(tmp_path / "rec.h5", imported(table(), Mapping.read(mapping())))
    assert list(tmp_path.iterdir()) == []


def test_what_is_no_recording_is_refused(tmp_path: Path) -> None:
    (tmp_path / "text.h5").write_text("no HDF5")
    with h5py.File(tmp_path / "other.h5", "w") as file:
        file.attrs["schema"] = "other/1"
    for name in ("text.h5", "other.h5"):
        with pytest.raises(RecordingError, match=f"{name} is not a"):
            load(tmp_path / name)
    with pytest.raises(RecordingError, match=r"the recording none\.h5 does not exist"):
        load(tmp_path / "none.h5")


def test_a_channel_that_was_not_measured_is_named_beside_those_that_were(tmp_path: Path) -> None:
    found = imported(table(), Mapping.read(mapping()))
    assert found.has("x_meas") and not found.has("x_cmd", 1) and found.numbers("station") == [1]
    with pytest.raises(RecordingError, match=r"x_cmd.1: was not measured \(the recording contains x_meas.1"):
        found.get("x_cmd", 1)


def test_a_runs_recording_is_a_measured_one(tmp_path: Path) -> None:
    plan = template("two-storeys").model_copy(update={"duration": 1.0})
    result = simulate(plan, MotionLibrary(None))
    recording.save(tmp_path / "run.h5", result)
    run, found = recording.load(tmp_path / "run.h5"), load(tmp_path / "run.h5")
    assert (found.dt, found.test, found.title) == (run.dt, "hybrid", plan.name)
    np.testing.assert_allclose(found.time, run.time)
    same = {"ag": "ag", "x_floor.2": "x_floor.2", "x_cmd.1": "x_cmd.1", "x_comp.2": "x_comp.2", "f_meas.2": "f_meas.2"}
    for key, own in same.items():
        role, _, number = key.partition(".")
        np.testing.assert_array_equal(found.get(role, int(number or 1)), run.signal(own))
    assert not any(key.startswith(("error", "ti", "d_alpha")) for key in found.keys)
    assert isinstance(found, Measured) and found.numbers("station") == [1, 2]
