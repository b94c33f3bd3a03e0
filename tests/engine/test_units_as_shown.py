"""What the program shows with a unit is read back when typed: every quantity, channel and unit, in each form of a number."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest

from rths_engine.formats.units_in_text import ACCELERATION_UNITS, checked_unit
from rths_engine.foundation import unit_names, unit_text, units
from rths_engine.foundation.errors import PlanError, RthsError
from rths_engine.foundation.part import validated
from rths_engine.parts.physics.wording import said
from rths_engine.planning.plan import Plan
from rths_engine.recordings.measured.roles import UNITS as MEASURED
from rths_engine.results.channels import CHANNELS
from rths_engine.results.measures import MEASURES

NUMBERS = (0.4, -0.4, 1.5e-7, -3.25e8, 36007.0)  # in the unit shown
FORMS = ("{:.6g}", "{:.3e}", "{:.4g}", "{!r}")
SIGNS = (("-", "-"), ("-", "−"))


def quantities(schema: Any) -> Iterator[tuple[str, str]]:
    """Unit and unit shown of every number in a schema."""
    if isinstance(schema, dict):
        if "shown" in schema:
            yield schema["unit"], schema["shown"]
        for one in schema.values():
            yield from quantities(one)
    elif isinstance(schema, list):
        for one in schema:
            yield from quantities(one)


def put_out() -> Iterator[tuple[str, str]]:
    """Unit and unit shown of every channel and every measure."""
    yield from ((one.unit, one.shown) for one in CHANNELS.values())
    yield from ((one.unit, one.shown) for one in MEASURES)


PAIRS = sorted({*quantities(Plan.model_json_schema()), *put_out(), *((unit, unit) for unit in units.UNITS)})


@pytest.mark.parametrize(("unit", "shown"), PAIRS)
def test_a_quantity_typed_as_it_is_shown_is_the_same_quantity(unit: str, shown: str) -> None:
    for number in NUMBERS:
        for form in FORMS:
            for sign, written in SIGNS:
                text = form.format(number).replace(sign, written)
                si = units.to_si(float(form.format(number)), shown)
                assert units.parse(f"{text} {units.pretty(shown)}", unit) == si
                assert units.parse(f"{text} {shown}", unit) == si


@pytest.mark.parametrize(("unit", "shown"), PAIRS)
def test_a_size_in_a_sentence_is_read_back_to_its_digits(unit: str, shown: str) -> None:
    for number in NUMBERS:
        si = units.to_si(number, shown)
        assert units.parse(said(si, shown), unit) == pytest.approx(si, rel=5e-3)


@pytest.mark.parametrize(
    ("text", "unit", "si"),
    [
        ("0.4 1/mm²", "1/(m^2)", 4e5),
        ("0.4 1/mm^2", "1/(m^2)", 4e5),
        ("0.4 1/(mm^2)", "1/(m^2)", 4e5),
        ("0.4 mm⁻²", "1/(m^2)", 4e5),
        ("0.4 mm**-2", "1/(m^2)", 4e5),
        ("2 1/mm²/s", "1/(m^2*s)", 2e6),
        ("−1.5e−3 kN·s/m", "N*s/m", -1.5),
        ("5 kN s/m", "N*s/m", 5e3),
        ("5 kN × (s/m)ⁿ", "N*(s/m)^n", 5e3),
        ("4 µm", "m", 4e-6),
        ("7mm", "m", 7e-3),
        ("0.3 m s^-2", "m/s^2", 0.3),
    ],
)
def test_other_ways_to_write_a_unit_are_read(text: str, unit: str, si: float) -> None:
    assert units.parse(text, unit) == pytest.approx(si, rel=1e-15)


@pytest.mark.parametrize(
    "text",
    ["1 zz", "1 kN", "1 mm^9", "1 m/", "1 (m", "1 m)", "1 ^2", "1 m^", "1 m^x", "1 " + "(" * 10_000, "1 " + "m " * 100_000],
)
def test_another_unit_is_refused_with_the_units_that_fit(text: str) -> None:
    with pytest.raises(RthsError, match="needs a unit of length: m, mm, cm"):
        units.parse(text, "m")


@pytest.mark.parametrize("text", ["", "m", "1,5 m", "1 2 m", "-", "−", "1e m 3", "0x1 m", "nan m"])
def test_text_without_one_number_is_refused(text: str) -> None:
    with pytest.raises(RthsError):
        units.parse(text, "m")


def test_no_two_units_are_shown_or_read_as_one_another() -> None:
    assert len({units.pretty(unit) for unit in units.UNITS}) == len(units.UNITS)
    assert [units.named(unit_text.shown(unit)) for unit in units.UNITS if unit != "1"] == [
        unit for unit in units.UNITS if unit != "1"
    ]


def test_the_units_of_columns_and_records_are_read_as_they_are_shown() -> None:
    for unit in MEASURED:
        assert unit_names.known(unit_text.shown(unit) or "-") == unit
    for unit in ACCELERATION_UNITS:
        assert checked_unit(unit_text.shown(unit)) == unit


def test_a_plan_takes_a_quantity_as_its_report_shows_it() -> None:
    with pytest.raises(PlanError) as raised:
        validated(Plan, {"stations": [{"limits": {"displacement": "−5 mm²"}}]})
    assert "needs a unit of length" in str(raised.value)
    aic = {"kind": "aic", "kp": "0.4 1/mm²"}
    effect = {"kind": "cubic_stiffness", "stiffness": "−3 kN/m³"}
    plan: Any = validated(Plan, {"stations": [{"compensator": aic, "specimen_physics": [effect]}]})
    assert plan.stations[0].compensator.kp == 0.4e6
    assert plan.stations[0].specimen_physics[0].stiffness == -3e3
