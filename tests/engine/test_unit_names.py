"""Every spelling of a unit is read as its unit, in any case and brackets; an unknown unit is said to be unknown."""

from __future__ import annotations

import math
import re

import pytest
import scipy.constants as known
from hypothesis import given
from hypothesis import strategies as st

from rths_engine.formats.units_in_text import acceleration_in, unit_in
from rths_engine.formats.units_row import evidence, is_units_row
from rths_engine.foundation import unit_names, unit_text, units
from rths_engine.foundation.errors import FileError
from rths_engine.foundation.unit_spellings import AMBIGUOUS, AMBIGUOUS_IN_ANY_CASE, NO_UNIT, SPELLINGS

PAIRS = [(unit, spelling) for unit, spellings in SPELLINGS.items() for spelling in spellings]

# factors from scipy.constants (CODATA, NIST SP 811) and prefixes of SI; none of this project
ONES = ("m", "s", "kg", "N", "Pa", "J", "V", "A", "K", "degC", "Hz", "rad", "count", "US")
SYMBOLS: dict[str, float] = dict.fromkeys(ONES, 1.0) | {
    "min": known.minute, "h": known.hour, "in": known.inch, "ft": known.foot, "gal": known.centi,
    "g": known.g, "mg": known.g * known.milli, "t": known.metric_ton, "%": known.centi, "kNm": known.kilo,
    "lb": known.pound_force, "lbf": known.pound_force, "kip": known.kilo * known.pound_force,
    "kgf": known.kilogram_force, "tf": known.metric_ton * known.g, "tonf": known.short_ton * known.g, "bar": known.bar,
    "psi": known.psi, "ksi": known.kilo * known.psi, "deg": known.degree, "degF": known.degree_Fahrenheit, "ohm": 1.0,
}  # fmt: skip
PREFIXES: dict[str, float] = {
    "k": known.kilo,
    "M": known.mega,
    "G": known.giga,
    "d": known.deci,
    "c": known.centi,
    "m": known.milli,
    "u": known.micro,
}
PREFIXES |= {"da": known.deka}


def factor_of(symbol: str) -> float:
    if symbol in SYMBOLS:
        return SYMBOLS[symbol]
    prefix = max((one for one in PREFIXES if symbol.startswith(one) and symbol[len(one) :] in SYMBOLS), key=len)
    return PREFIXES[prefix] * SYMBOLS[symbol[len(prefix) :]]


@pytest.mark.parametrize("unit", units.UNITS)
def test_every_unit_has_a_dimension_and_the_factor_of_an_independent_source(unit: str) -> None:
    assert units.dimension(unit)
    if unit == "g/10":
        expected = known.g / 10
    else:
        powers = unit_text.powers(unit)
        assert powers is not None
        # a power by the free exponent n is that of the unit at n = 1
        expected = math.prod(factor_of(symbol) ** power for (symbol, _), power in powers.items())
    if unit == "um/m":
        expected = known.micro
    assert units.factor(unit) == pytest.approx(expected, rel=1e-12)


def test_the_zeros_of_temperatures_are_those_of_scipy() -> None:
    for unit, scale in (("degC", "Celsius"), ("degF", "Fahrenheit")):
        for value in (-40.0, 0.0, 21.5, 100.0):
            assert units.to_si(value, unit) == pytest.approx(known.convert_temperature(value, scale, "Kelvin"), rel=1e-12)
            assert units.from_si(units.to_si(value, unit), unit) == pytest.approx(value, abs=1e-9)


@given(
    st.sampled_from(PAIRS),
    st.sampled_from([str, str.upper, str.title, str.capitalize]),
    st.sampled_from(["{}", "({})", "[{}]", " {} "]),
)
def test_every_spelling_is_read_as_its_unit_in_any_case_and_brackets(pair: tuple[str, str], case: object, around: str) -> None:
    unit, spelling = pair
    written = case(spelling)  # type: ignore[operator]
    if written in AMBIGUOUS:
        return
    read = unit_names.read(around.format(written))
    assert (read.unit, read.scale, read.problem) == (unit, 1.0, "")


@given(st.sampled_from(list(units.UNITS)), st.sampled_from(["{}", "({})", "[{}]", "{{{}}}", " {} "]))
def test_every_unit_is_read_by_its_own_name_and_as_it_is_shown(unit: str, around: str) -> None:
    assert unit_names.known(around.format(unit)) == unit
    assert unit_names.known(unit_text.shown(unit) or "-") == unit


def test_no_spelling_stands_for_two_units() -> None:
    spellings = [spelling for _, spelling in PAIRS]
    assert sorted(set(spellings)) == sorted(spellings)
    assert not set(spellings) & (set(AMBIGUOUS_IN_ANY_CASE) | NO_UNIT)
    assert {unit for unit, _ in PAIRS} <= set(units.UNITS)


@pytest.mark.parametrize(
    ("text", "unit", "scale"),
    [
        ("cm/s2", "cm/s^2", 1.0),
        ("CM/SEC/SEC", "cm/s^2", 1.0),
        ("m.s-2", "m/s^2", 1.0),
        ("m·s⁻²", "m/s^2", 1.0),
        ("ms^-2", "m/s^2", 1.0),
        ("meters per second squared", "m/s^2", 1.0),
        ("Millimeter pro Sekunde", "mm/s", 1.0),
        ("mm par seconde", "mm/s", 1.0),
        ("KN/MM", "kN/mm", 1.0),
        ("Kilopond", "kgf", 1.0),
        ("t-f", "tf", 1.0),
        ("US tons-force", "tonf(US)", 1.0),
        ("MN", "MN", 1.0),
        ("mN", "mN", 1.0),
        ("KN", "kN", 1.0),
        ("gal", "gal", 1.0),
        ("mg", "mg", 1.0),
        ("milli-g", "mg", 1.0),
        ("G", "g", 1.0),
        ("g/10", "g/10", 1.0),
        ("0.1 g", "g/10", 1.0),
        ("0.1g", "g/10", 1.0),
        ("10^-3 g", "mg", 1.0),
        ("10⁻³ g", "mg", 1.0),
        ("1e-3 m", "mm", 1.0),
        ("x10-6 strain", "um/m", 1.0),
        ("10^3 N", "kN", 1.0),
        ("0.05 g", "g", 0.05),
        ("g/100", "g", 0.01),
        ("2e-5 g", "g", 2e-5),
        ("µε", "um/m", 1.0),
        ("με", "um/m", 1.0),
        ("µm/m", "um/m", 1.0),
        ("µST", "um/m", 1.0),
        ("(°C)", "degC", 1.0),
        ("Fuß", "ft", 1.0),
        ("degré", "deg", 1.0),
        ("kine", "cm/s", 1.0),
        ("in.", "in", 1.0),
        ("(tonf(US))", "tonf(US)", 1.0),
    ],
)
def test_units_are_read_as_files_write_them(text: str, unit: str, scale: float) -> None:
    read = unit_names.read(text)
    assert (read.unit, read.problem) == (unit, "") and read.scale == pytest.approx(scale, rel=1e-12)


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        ("µstr", "the unit 'µstr' is not known"),
        ("furlong", "the unit 'furlong' is not known"),
        ("mPa", "the unit 'mPa' is not known"),
        ("g/0", "the unit 'g/0' is not known"),
        ("x" * 60, "is not known"),
        ("tonf", "the unit 'tonf' has several meanings: choose tf or tonf(US)"),
        ("Tons", "choose tf or tonf(US)"),
        ("mn", "choose mN or MN"),
        ("Mg", "choose mg or t"),
        ("k", "choose kip or K"),
        ("10 kN", "a factor or the range of a sensor"),
        ("1000 lb", "a factor or the range of a sensor"),
    ],
)
def test_an_unknown_unit_is_neither_a_unit_nor_no_unit(text: str, problem: str) -> None:
    read = unit_names.read(f"({text})")
    assert not read.unit and not read.none and problem in read.problem


@pytest.mark.parametrize("text", ["", "  ", "()", "n/a", "none", "--"])
def test_no_unit_is_no_problem(text: str) -> None:
    assert unit_names.read(text).none


@given(st.text(max_size=60))
def test_any_text_is_no_unit_a_unit_or_an_unknown_unit(text: str) -> None:
    read = unit_names.read(text)
    assert [read.none, bool(read.unit), bool(read.problem)].count(True) == 1
    assert not read.unit or (read.unit in units.UNITS and math.isfinite(read.scale) and read.scale > 0)


@pytest.mark.parametrize(
    ("text", "unit"),
    [
        ("Acceleration in g/10, dt = 0.01 s", "g/10"),
        ("# dt = 0.01, units: cm/s^2", "cm/s^2"),
        ("400 points of accel data equally spaced at  .010 sec, in cm/sec2. (8f10.3)", "cm/s^2"),
        ("ACCELERATION TIME SERIES IN UNITS OF G", "g"),
        ("time(s)  disp(cm)  vel(cm/s)  acc(cm/s2)", "cm/s^2"),
        ("acceleration (mg)", "mg"),
        ("units: 10^-3 g", "mg"),
        ("acc m.s-2", "m/s^2"),
        ("data in ft/s/s", "ft/s^2"),
        ("cm/s2 = gal", "cm/s^2"),
        ("in 0.1 g", "g/10"),
        ("(1e-3 g)", "mg"),
        ("(x10-3 g)", "mg"),
        ("station (MG), units cm/s^2", "cm/s^2"),
        ("acc (MG)", None),
        ("peak (0.35 g)", None),
        ("peak (0.35 g), units: gal", "gal"),
        ("in inches", None),
        ("in g/cm", None),
        ("g and cm/s2: in g, once in cm/s2", None),
    ],
)
def test_a_sentence_of_a_header_names_its_unit_of_acceleration(text: str, unit: str | None) -> None:
    assert unit_in(text) == unit


def test_a_unit_of_a_header_that_cannot_be_applied_refuses_the_record() -> None:
    assert acceleration_in("in 0.05 g").scale == 0.05
    with pytest.raises(FileError, match=re.escape("values in 0.05 of g cannot be read")):
        unit_in("in 0.05 g")


@pytest.mark.parametrize(
    ("row", "units_row"),
    [
        (["s", "kN", "mm", "µε"], True),
        (["s", "kN", "mm", "µstr"], True),
        (["(s)", "(kN)", "", "-"], True),
        (["t", "x", "v", "f"], False),
        (["Time", "Load", "Disp", "Gauge"], False),
        (["s", "Load", "Disp", "Gauge"], False),
    ],
)
def test_a_row_of_units_can_hold_an_unknown_unit(row: list[str], units_row: bool) -> None:
    assert is_units_row(row) is units_row


def test_the_cells_that_made_a_row_a_row_of_units_are_named() -> None:
    assert evidence(["s", "kN", "mm", "µε"]) == ""
    told = evidence(["s", "kN", "mm", "µstr"])
    assert told == "the row below the names holds units, because of s, kN, mm; not known: µstr"
