"""The next test is the one, within the rig's limits, whose lambda between two models is the largest."""

from __future__ import annotations

import re

import numpy as np
import pytest

from rths_engine.diagnosis.components import Actuator, ActuatorData, Specimen, SpecimenData
from rths_engine.diagnosis.fitting import Recordings
from rths_engine.diagnosis.next_test import CYCLES, FREQUENCIES, SHARES, next_test
from rths_engine.parts.actuators.first_order_delay import FirstOrderDelay
from rths_engine.parts.physics.specimen.cubic_stiffness import CubicStiffness
from rths_engine.parts.specimens.linear import LinearSpecimen
from tests.engine.diagnosis.made import Gain, linear, noisy, recordings

DT, SIGMA = 0.01, 50.0
SPRING = LinearSpecimen(stiffness=2e6, damping=0.0)
LARGEST = 0.02


def pressed() -> Recordings:
    """A spring moved by LARGEST."""
    x = LARGEST * np.sin(2 * np.pi * 0.5 * np.arange(500) * DT)
    data = SpecimenData(DT, 0.0, True, x, SPRING.stiffness * x, np.ones(500))
    data.__dict__["smooth"] = x
    return recordings(Specimen("specimen:1", (SPRING,)), data, sigma=SIGMA)


def test_a_cubic_spring_is_told_by_the_largest_stroke() -> None:
    """The models differ by k_3 x^3: of a slow sine of as many cycles, the larger and the longer the better. With slope over one
    cycle and 5 of full amplitude, the mean of sin^6 is 5/16."""
    used = pressed()
    found = next_test(used, [SPRING], [SPRING, CubicStiffness(stiffness=1e7)], stroke=0.1, speed=10.0)
    assert found is not None
    amplitude = max(SHARES) * LARGEST
    assert found.signal == f"a sine of {1e3 * amplitude:g} mm at {min(FREQUENCIES):g} Hz, {CYCLES} cycles"
    samples = CYCLES / min(FREQUENCIES) / DT
    full = (1e7 * amplitude**3 / SIGMA) ** 2 * samples * 5 / 16
    assert 5 / 6 * full < found.expected < full  # the first of six cycles rises


def test_the_expected_lambda_of_a_stiffness_is_its_closed_form() -> None:
    """k off by d: (d a / sigma)^2 times the sum of the sine's squares; the first of six cycles rises: of u sin between 0 and 1
    the mean of its square is 1/6 - 1/(16 pi^2), of the five others 1/2."""
    other = SPRING.model_copy(update={"stiffness": SPRING.stiffness + 1e4})
    found = next_test(pressed(), [SPRING], [other], stroke=0.1, speed=10.0)
    assert found is not None
    cycle = 1 / min(FREQUENCIES) / DT
    squares = cycle * (1 / 6 - 1 / (16 * np.pi**2) + 5 / 2)
    assert found.expected == pytest.approx((1e4 * 1.5 * LARGEST / SIGMA) ** 2 * squares, rel=1e-3)  # 1000 samples a cycle


@pytest.mark.parametrize(("stroke", "speed"), [(0.012, 10.0), (0.1, 0.02), (0.003, 0.01)])
def test_no_test_is_proposed_beyond_the_stroke_or_the_speed(stroke: float, speed: float) -> None:
    found = next_test(pressed(), [SPRING], [SPRING, CubicStiffness(stiffness=1e9)], stroke, speed)
    assert found is not None
    size, frequency = (float(one) for one in re.findall(r"of ([\d.e-]+) mm at ([\d.]+) Hz", found.signal)[0])
    assert 1e-3 * size <= stroke * 1.01  # three digits in words
    slope = 4.0 if "triangle" in found.signal else 2 * np.pi
    assert slope * frequency * 1e-3 * size <= speed * 1.01


def test_a_rig_too_slow_for_any_test_gets_no_proposal() -> None:
    assert next_test(pressed(), [SPRING], [SPRING, CubicStiffness(stiffness=1e9)], stroke=0.1, speed=1e-9) is None


def test_a_delay_is_told_by_the_fastest_motion() -> None:
    command = LARGEST * np.sin(2 * np.pi * 0.5 * np.arange(500) * DT)
    fast, slow = FirstOrderDelay(alpha=2.0), FirstOrderDelay(alpha=3.0)
    data = ActuatorData(DT, 0.0, True, command, command, None)
    used = recordings(Actuator("actuator:1", (fast,)), data, sigma=1e-5)
    found = next_test(used, [fast], [slow], stroke=0.1, speed=0.2)
    assert found is not None
    # six cycles of f Hz last 6 / f s: the sum of squares goes with a^2 f, and with a f < 0.2 / 2 pi the largest stroke wins
    assert found.signal.startswith("a sine of 30 mm at 1 Hz")


def test_models_that_no_test_separates_get_no_proposal() -> None:
    """k off by 1: at 30 mm the force differs by 0.03 N beside a noise of 50 N."""
    other = SPRING.model_copy(update={"stiffness": SPRING.stiffness + 1.0})
    assert next_test(pressed(), [SPRING], [other], stroke=0.1, speed=10.0) is None


def test_a_component_without_a_drive_gets_no_proposal() -> None:
    used = recordings(linear(), noisy([Gain()], 1))
    assert next_test(used, [Gain()], [Gain(gain=3.0)], 1.0, 1.0) is None
