"""The numbers that a fit moves, and the vector they stand in."""

from __future__ import annotations

import math

import numpy as np
import pytest

from rths_engine.diagnosis.components import ClockSkew, Specimen, StepError
from rths_engine.diagnosis.free import SMALLEST, moved, numbers, vector
from rths_engine.parts import physics
from rths_engine.parts.physics.specimen.backlash import Backlash
from rths_engine.parts.physics.specimen.bouc_wen_hysteresis import BoucWenHysteresis
from rths_engine.parts.specimens.linear import LinearSpecimen
from tests.engine.diagnosis.made import Gain, Wave, linear

SPRING = LinearSpecimen(stiffness=2e6, damping=3e5)


def test_every_number_of_planned_parts_and_effects_is_free_in_order() -> None:
    found = numbers(linear(), [Gain(gain=2.0), Wave(size=0.1, storey=1), Wave(size=0.2, storey=3)])
    assert [(one.owner, one.field) for one in found] == [(0, "gain"), (1, "size"), (2, "size")]


def test_a_number_that_the_plan_has_at_zero_is_no_part_of_its_model() -> None:
    spring = LinearSpecimen(stiffness=2e6, damping=0.0)
    found = numbers(Specimen("specimen:1", (spring,)), [spring])
    assert [one.field for one in found] == ["stiffness"]


def test_what_is_loose_and_planned_effects_are_free_from_zero() -> None:
    base = (SPRING, ClockSkew(), StepError())
    found = numbers(Specimen("specimen:1", base), base)
    assert [(one.owner, one.field) for one in found][-2:] == [(1, "delay"), (2, "share")]


def test_numbers_that_an_effect_holds_are_not_moved() -> None:
    hysteresis = BoucWenHysteresis(strength=1e3, yield_displacement=1e-3)
    held = set(physics.SEARCHES[BoucWenHysteresis].held)
    assert held
    free = {one.field for one in numbers(Specimen("specimen:1", (SPRING,)), [SPRING, hysteresis]) if one.owner == 1}
    assert free and not free & held


def test_values_come_back_from_the_vector() -> None:
    parts = [SPRING, Backlash(gap=0.002)]
    free = numbers(Specimen("specimen:1", (SPRING,)), parts)
    again = moved(parts, free, vector(parts, free))
    for number in free:  # through a logarithm or a division: rounding
        one, other = (getattr(some[number.owner], number.field) for some in (parts, again))
        assert other == pytest.approx(one, rel=1e-14)


def test_a_number_is_counted_in_units_of_its_planned_value() -> None:
    (gain,) = numbers(linear(gain=4.0), [Gain(gain=5.0)])
    assert not gain.logarithmic
    assert gain.to_z(6.0) == pytest.approx(1.5) and gain.from_z(1.5) == pytest.approx(6.0)
    assert gain.spread == math.inf


def test_a_planned_number_with_a_tolerance_has_it_as_its_spread() -> None:
    (gain,) = numbers(linear(gain=4.0, share=0.03), [Gain(gain=5.0)])
    assert gain.planned == pytest.approx(1.0) and gain.spread == 0.03


def test_a_number_that_must_be_positive_moves_by_its_logarithm_and_never_to_zero() -> None:
    parts = [SPRING, BoucWenHysteresis(strength=1e3, yield_displacement=2e-3)]
    number = next(
        one for one in numbers(Specimen("specimen:1", (SPRING,)), parts) if one.owner == 1 and one.field == "yield_displacement"
    )
    assert number.logarithmic
    assert number.to_z(2e-3) == pytest.approx(math.log(2e-3))
    assert number.from_z(-1e3) >= SMALLEST
    assert number.from_z(1e3) == number.high  # the end of an interval that is wider than any float
    assert number.from_z(number.to_z(2e-3) + math.log(2)) == pytest.approx(4e-3)


def test_bounds_of_the_declaration_hold_whatever_the_vector_says() -> None:
    parts = [Gain(), Wave(size=0.5)]
    free = numbers(linear(), parts)
    low, high = free[1].bounds
    assert free[1].from_z(low) == -1e3 and free[1].from_z(high) == 1e3
    far = moved(parts, free, np.array([1.0, 1e9]))[1]
    assert isinstance(far, Wave) and far.size == 1e3
