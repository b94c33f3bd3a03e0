"""The linear parts that are fitted to a recording are those that made it, and a diagnosis starts from them."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.signal import lfilter

from rths_engine.diagnosis.linear import linear_plan
from rths_engine.diagnosis.verdict import diagnose
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import RecordingError
from rths_engine.parts.ground_motions import MotionLibrary
from rths_engine.recordings.excitation import differences
from rths_engine.recordings.measured import Measured, MeasuredChannel
from tests.engine import recorded_specimens as made

RATE = 256.0
TIME = np.arange(2048) / RATE
WAVE = 0.02 * np.sin(2 * np.pi * 0.7 * TIME) + 0.01 * np.sin(2 * np.pi * 2.1 * TIME)


def measured(test: str | None, units: dict[str, str] | None = None, **channels: Array) -> Measured:
    given = {"f_meas": "N", **(units or {})}
    numbers = {"drive": None}
    rows = [MeasuredChannel(role, numbers.get(role, 1), values, given.get(role, "m")) for role, values in channels.items()]
    return Measured(1 / RATE, tuple(rows), test=test)


def test_a_spring_and_a_dashpot_are_fitted_beside_the_zero_of_the_load_cell() -> None:
    force = 2e6 * WAVE + 3e5 * np.gradient(WAVE, 1 / RATE) + 5e3
    found = linear_plan(measured(None, x_meas=WAVE, f_meas=force), "bench")
    specimen = found.stations[0].specimen.model_dump()
    assert specimen["stiffness"] == pytest.approx(2e6, rel=1e-3) and specimen["damping"] == pytest.approx(3e5, rel=1e-3)
    assert found.test == "specimen" and found.name == "Linear model fitted to bench" and "k = 2e+06 N/m" in found.notes


def test_the_delay_of_an_actuator_and_the_gain_of_a_voltage_drive_are_fitted() -> None:
    followed = lfilter([1 / 6], [1, 1 / 6 - 1], WAVE)
    found = linear_plan(measured("actuator", x_cmd=WAVE, x_meas=followed))
    assert found.stations[0].actuator.model_dump()["alpha"] == pytest.approx(6, rel=1e-3)
    voltage = np.sin(2 * np.pi * TIME) + 0.1
    driven = linear_plan(measured("actuator", {"drive": "V"}, drive=voltage, x_meas=0.04 * np.cumsum(voltage - 0.05) / RATE))
    drive = driven.stations[0].actuator.model_dump()
    assert drive["gain"] == pytest.approx(0.04, rel=0.02) and drive["rest_voltage"] == pytest.approx(0.05, abs=0.01)


def test_a_recording_is_diagnosed_by_the_linear_plan_that_is_fitted_to_it() -> None:
    recording = made.recording(3)
    plan = linear_plan(recording)
    assert differences(plan, recording, MotionLibrary(None)) == []
    assert diagnose(plan, recording).verdict.verdict in ("consistent", "recalibrate")


@pytest.mark.parametrize(
    ("recording", "told"),
    [
        (measured("hybrid", x_meas=WAVE, f_meas=WAVE), "whose structure only its plan gives"),
        (measured("specimen", x_meas=WAVE, f_meas=-WAVE), "acts against displacement and velocity"),
        (measured("specimen", x_meas=WAVE), "has no measured force"),
        (measured("specimen", f_meas=WAVE), "has no measured displacement"),
        (measured("actuator", {"drive": "V"}, drive=WAVE, x_meas=-np.cumsum(WAVE)), "moves against its voltage"),
    ],
)
def test_what_no_linear_model_fits_is_refused_with_the_reason(recording: Measured, told: str) -> None:
    with pytest.raises(RecordingError, match=told):
        linear_plan(recording)
