"""Sizes in sentences: three digits, in a unit that fits."""

from __future__ import annotations

import pytest

from rths_engine.foundation import units
from rths_engine.parts.physics.wording import SCALES, fitting, lost, said


@pytest.mark.parametrize(
    ("value", "unit", "text"),
    [
        (18300.0, "kN", "18.3 kN"),
        (0.7, "kN", "0.7 N"),
        (2.5e7, "kN", "25 MN"),
        (3.2e-7, "mm", "0.32 µm"),
        (1.25e9, "kN/m^3", "1.25 N/mm³"),
        (0.0, "kN", "0 kN"),
        (0.00004, "%", "0.004 %"),
    ],
)
def test_a_size_is_said_in_a_unit_that_gives_a_short_number(value: float, unit: str, text: str) -> None:
    assert said(value, unit).replace("um", "µm") == text


@pytest.mark.parametrize(
    ("rate", "unit", "share", "per"),
    [(5.8e-7, "MJ", "58 %", "MJ"), (1.84e-3, "MJ", "0.184 %", "J"), (5e-9, "MJ", "0.5 %", "MJ"), (20.0, "mm", "2 %", "mm")],
)
def test_a_loss_is_said_per_unit_in_which_it_is_below_the_whole(rate: float, unit: str, share: str, per: str) -> None:
    assert lost(rate, unit) == (share, per)


def test_each_scale_holds_units_of_one_dimension_from_small_to_large() -> None:
    for scale in SCALES:
        assert len({units.UNITS[unit][0] for unit in scale}) == 1
        factors = [units.factor(unit) for unit in scale]
        assert factors == sorted(factors)


def test_a_parameter_is_shown_in_its_own_unit_while_that_gives_a_short_number() -> None:
    assert [fitting(value, "1/MJ") for value in (5.8e-7, 0.0, 1.84e-3, 1.84e-2)] == ["1/MJ", "1/MJ", "1/MJ", "1/kJ"]
    assert fitting(1.37e-7, "1/kN") == "1/MN"
    assert fitting(1e-5, "%") == "%"  # a share has no other unit
