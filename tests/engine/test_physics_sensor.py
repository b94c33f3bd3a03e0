"""Physics of the left-out effects of sensors and of the ground motion."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from rths_engine.parts.physics.effect import Effect
from rths_engine.parts.physics.input import BaselineDrift, GroundScaleError, LowPass, TimeShift
from rths_engine.parts.physics.sensor import (
    DisplacementDrift,
    DisplacementDropout,
    DisplacementOffset,
    DisplacementTimeSkew,
    ForceClipping,
    ForceScaleError,
)
from tests.engine.effects import stepped

DT = 1 / 1024
TIME = DT * np.arange(1024)
READING = 0.02 * np.sin(2 * np.pi * 3 * TIME)


@pytest.mark.parametrize(
    ("effect", "expected"),
    [
        (DisplacementOffset(error=-1e-3), READING - 1e-3),
        (DisplacementDrift(rate=2e-3), READING + 2e-3 * TIME),
        (ForceScaleError(share=0.05), 1.05 * READING),
        (ForceClipping(limit=0.015), np.clip(READING, -0.015, 0.015)),
    ],
    ids=lambda value: getattr(value, "kind", ""),
)
def test_a_sensor_reads_what_its_equation_says(effect: Effect, expected: np.ndarray) -> None:
    assert stepped(effect, READING, dt=DT) == pytest.approx(expected, abs=1e-15)


@settings(max_examples=25, deadline=None)
@given(skew=st.floats(-0.02, 0.05))
def test_a_skewed_sensor_reads_a_ramp_of_that_much_before(skew: float) -> None:
    found = stepped(DisplacementTimeSkew(delay=skew), 0.3 * TIME[:200], dt=DT)
    assert found[60:] == pytest.approx(0.3 * (TIME[60:200] - skew), abs=1e-12)


def test_a_late_sensor_reads_its_first_value_until_something_comes() -> None:
    found = stepped(DisplacementTimeSkew(delay=10 * DT), np.cos(TIME[:30]), dt=DT)
    assert found[:11] == pytest.approx(1.0)
    assert found[11:] == pytest.approx(np.cos(TIME[1:20]))


def test_a_dropout_holds_the_reading_of_its_begin_and_then_reads_on() -> None:
    found = stepped(DisplacementDropout(time=100 * DT, duration=50 * DT), READING, dt=DT)
    assert (found[:101] == READING[:101]).all()
    assert found[101:151] == pytest.approx(READING[100])
    assert (found[151:] == READING[151:]).all()


def test_a_dropout_begins_and_ends_within_a_substep_by_its_share() -> None:
    found = stepped(DisplacementDropout(time=10.25 * DT, duration=2 * DT), TIME, dt=DT)
    lost = (TIME - found)[10:15] / (TIME[10:15] - TIME[10] + 1e-30)
    assert lost == pytest.approx([0.0, 0.75, 1.0, 0.25, 0.0])


def test_a_ground_motion_is_scaled_shifted_and_drifts() -> None:
    assert GroundScaleError(share=-0.1).shaken(READING, DT) == pytest.approx(0.9 * READING)
    late = TimeShift(delay=2.5 * DT).shaken(READING, DT)
    assert late[3:] == pytest.approx((READING[1:-2] + READING[:-3]) / 2, abs=1e-12)
    early = TimeShift(delay=-3 * DT).shaken(READING, DT)
    assert early[:-3] == pytest.approx(READING[3:], abs=1e-12)
    drifting = BaselineDrift(offset=0.01, rate=0.02).shaken(READING, DT)
    assert drifting - READING == pytest.approx(0.01 + 0.02 * TIME)


@pytest.mark.parametrize("time_constant", [1e-6, 0.01, 0.2])
def test_the_low_passed_ground_motion_solves_its_equation(time_constant: float) -> None:
    found = LowPass(time_constant=time_constant).shaken(READING, DT)

    def rate(t: float, y: np.ndarray) -> np.ndarray:
        return np.asarray((np.interp(t, TIME, READING) - y) / time_constant)

    solved = solve_ivp(rate, (0, TIME[-1]), [0.0], method="LSODA", t_eval=TIME, rtol=1e-8, atol=1e-10, max_step=DT)
    assert np.abs(found - solved.y[0]).max() < 1e-4 * np.abs(READING).max()  # the solver's, across the corners of the input
