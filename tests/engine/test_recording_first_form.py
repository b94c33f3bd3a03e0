"""Recordings written as `rths-recording/1`, by the build before channels had one vocabulary, still open.

The file holds half a second of simulation 4 of Table III with three forces, two of them on floor 2.
"""

from __future__ import annotations

from pathlib import Path

import h5py
import numpy as np
import pytest

from app.live import from_recording
from app.runs.exports import csv_parts
from rths_engine.foundation.errors import RecordingError
from rths_engine.recordings import opening, run_file
from rths_engine.results.channels import channels
from rths_engine.running.run import Run
from tests.engine.plans import LIBRARY

OLD = Path(__file__).parent / "data" / "written-as-rths-recording-1.h5"


def test_its_channels_get_the_keys_of_today_and_forces_on_one_floor_are_added() -> None:
    with h5py.File(OLD, "r") as file:
        written, schema = file["signals"][:], file.attrs["schema"]
    recording = run_file.load(OLD)
    assert schema == "rths-recording/1"
    assert recording.channels == channels(recording.plan)
    for key, column in (("ag", 0), ("force_ext.1", 2), ("x_floor.2", 5), ("x_cmd.1", 6), ("f_meas.1", 9)):
        np.testing.assert_array_equal(recording.signal(key), written[:, column])
    np.testing.assert_array_equal(recording.signal("force_ext.2"), written[:, 1] + written[:, 3])


def test_running_its_plan_again_gives_its_signals_to_the_bit() -> None:
    recording = run_file.load(OLD)
    run = Run(recording.plan, LIBRARY)
    run.advance(run.total)
    assert run.channels == recording.channels
    np.testing.assert_array_equal(run.signals, recording.signals)
    np.testing.assert_array_equal(run.history, recording.history)


def test_diagnosis_live_view_and_csv_read_it() -> None:
    recording, measured = run_file.load(OLD), opening.load(OLD)
    assert measured.has("force_ext", 2) and not any(key.startswith("error") for key in measured.keys)
    schema, store = from_recording.replay(OLD, attempt=1)
    keys = [one["key"] for one in schema["channels"]]
    recorded = [one.key for one in recording.channels]
    assert keys[: len(recorded)] == recorded and store.count
    assert keys[len(recorded) :] == ["v_cmd.1", "v_cmd.2"]  # computed for viewers
    heading, *parts = csv_parts(OLD)
    assert heading.decode().startswith("t (s),ag (g),force_ext.2 (kN),force_ext.1 (kN),x_floor.1 (mm)")
    table = np.loadtxt(b"".join(parts).decode().splitlines(), delimiter=",")
    assert table[:, 1:] == pytest.approx(recording.signals / [one.factor for one in recording.channels], rel=1e-8)


def test_channels_that_no_build_wrote_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "odd.h5"
    path.write_bytes(OLD.read_bytes())
    with h5py.File(path, "r+") as file:
        file.attrs["channels"] = file.attrs["channels"].replace("s1.x_cmd", "s1_x_cmd")
    with pytest.raises(RecordingError, match=r"its channels do not match its plan: .*s1_x_cmd"):
        run_file.load(path)
