"""An actuator between its command and what its sensor reads."""

from __future__ import annotations

import numpy as np
import pytest

from rths_engine.diagnosis.components import Actuator, ActuatorData
from rths_engine.foundation.arrays import Array
from rths_engine.parts.actuators.first_order_delay import FirstOrderDelay
from rths_engine.parts.physics.sensor.offset import DisplacementOffset

DT = 0.01
TIME = DT * np.arange(1000)
COMMAND = 0.02 * np.sin(2 * np.pi * 0.8 * TIME)
LOAD = 1e4 * np.cos(2 * np.pi * 0.8 * TIME)
DELAY = FirstOrderDelay(alpha=3.0)


def delayed(alpha: float) -> Array:
    """d[q] = d[q-1] + (c[q] - d[q-1]) / alpha"""
    found, d = [], 0.0
    for one in COMMAND:
        d += (one - d) / alpha
        found.append(d)
    return np.array(found)


def data(force: Array | None = LOAD, x: Array = COMMAND, wanders: bool = False) -> ActuatorData:
    return ActuatorData(DT, 0.0, False, COMMAND, x, force, wanders)


def test_the_displacement_is_the_actuators_recursion() -> None:
    component = Actuator("actuator:1", (DELAY,))
    assert component.predicted([DELAY], data()) == pytest.approx(delayed(3.0)[None], abs=1e-15)
    offset = DisplacementOffset(error=1e-3)
    assert component.moved([DELAY, offset], data()) == pytest.approx(delayed(3.0) + 1e-3, abs=1e-15)
    assert component.spread(DELAY) == 0.05


def test_a_drive_that_wanders_is_compared_without_origin_and_creep() -> None:
    found = data(x=COMMAND + 0.3 + 0.02 * TIME, wanders=True).measured
    assert found == pytest.approx(data(x=COMMAND, wanders=True).measured, abs=1e-15)
    assert data(x=COMMAND + 0.3).measured[0] == pytest.approx(COMMAND + 0.3)


def test_sizes_seen_are_of_the_motion_and_the_work_of_the_force() -> None:
    """Peak of v, and |f v| of two sines in step: the mean of cos^2 is a half."""
    seen = data().seen()
    v = 0.02 * 2 * np.pi * 0.8
    assert (seen.x, seen.f) == pytest.approx((0.02, 1e4), rel=1e-3)
    assert seen.v == pytest.approx(v, rel=1e-3)  # of central differences: (2 pi f dt)^2 / 6
    assert seen.energy == pytest.approx(1e4 * v / 2 * 10.0, rel=2e-3)


def test_a_command_in_volts_is_not_taken_for_a_displacement() -> None:
    volts = ActuatorData(DT, 0.0, False, 100 * COMMAND, COMMAND, None)
    assert volts.seen().x == pytest.approx(0.02, rel=1e-3)


def test_effects_that_need_the_force_are_looked_for_only_where_it_was_measured() -> None:
    component = Actuator("actuator:1", (DELAY,))
    with_force, without = ({one.id for one in component.hypotheses(data(force))} for force in (LOAD, None))
    assert with_force - without == {"force_compliance", "valve_flow"}
    assert {"delay_error", "backlash", "gain_error", "offset"} <= without


def test_terms_of_an_unknown_law_take_the_force_where_there_is_one() -> None:
    component = Actuator("actuator:1", (DELAY,))
    names = [{one.formula for one in component.features([DELAY], data(force))} for force in (LOAD, None)]
    assert names[0] - names[1] == {"f", "f |f|"}
    for term in component.features([DELAY], data()):
        assert term.response.shape == data().measured.shape


def test_the_output_is_told_against_the_command() -> None:
    x, v = Actuator("actuator:1", (DELAY,)).signals(data())
    assert (x.unit, v.unit) == ("m", "m/s")
    assert x.values == pytest.approx(COMMAND) and v.values == pytest.approx(np.gradient(COMMAND, DT))
