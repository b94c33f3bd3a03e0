"""Acceleration units as they are written in headers."""

from __future__ import annotations

import re

from rths_engine.foundation import unit_names, units
from rths_engine.foundation.errors import FileError, Issue
from rths_engine.foundation.unit_names import Written

ACCELERATION_UNITS = units.of_dimension("acceleration")

_CHOICES = "choose one of " + ", ".join(ACCELERATION_UNITS)
_PER_SECOND_SQUARED = (
    r"(?:\s*/\s*s(?:ec)?\s*(?:\^|\*\*)?\s*(?:2|²)|\s*/\s*s(?:ec)?\s*/\s*s(?:ec)?|\s*\.?\s*s(?:\^|\*\*)?\s*[-⁻−]\s*[2²])"
)
_POWER = r"(?:(?:1e[-+]?\d+|[x*]?\s*10\s*(?:\^|\*\*)?\s*[-+]\d+|10\s*(?:\^|\*\*)\s*\d+)\s*[*x]?\s*)"
_FACTOR = rf"(?:{_POWER}|(?:\d+\.?\d*|\.\d+)\s*[*x]?\s*)"
_LENGTHS = r"(?:[cm]?m|in|ft)"
_PHRASES = (
    re.compile(rf"(?<![a-z])({_LENGTHS}{_PER_SECOND_SQUARED})(?![a-z])", re.IGNORECASE),
    re.compile(r"(?<![a-z])(gals?)(?![a-z])", re.IGNORECASE),
    re.compile(rf"[(\[]\s*({_POWER}?m?g(?:'s)?(?:\s*/\s*10+)?)\s*[)\]]", re.IGNORECASE),
    re.compile(
        rf"\b(?:units?\s*(?:of|in|are|is|[:=]|\s)*|in\s+(?:units?\s+of\s+)?)({_FACTOR}?m?g(?:'s)?(?:\s*/\s*10+)?)(?![\w/%])",
        re.IGNORECASE,
    ),
)


def acceleration_in(text: str) -> Written:
    """The unit of acceleration in a sentence. It states none where the text names none, or several different units.

    `(0.35 g)` is a value, not a unit; `in 0.1 g` and `(10^-3 g)` are units. A text such as `(MG)`, which has several meanings,
    can be the code of a station, and states no unit.
    """
    found: dict[float, Written] = {}
    for pattern in _PHRASES:
        for match in pattern.finditer(text):
            written = unit_names.read(match[1])
            if written.dimension == "acceleration":
                found.setdefault(written.scale * units.factor(written.unit), written)
    return next(iter(found.values())) if len(found) == 1 else Written("")


def unit_in(text: str) -> str | None:
    """The acceleration unit that `text` names; None where it names no unit or several units.

    Raises FileError where the unit is scaled by a number that no unit of the table has.
    """
    found = acceleration_in(text)
    if found.unit and not found.plain:
        fix = f"multiply the values by {found.scale:g} and state {found.unit} in the header"
        raise FileError(Issue("unit", f"values in {found.scale:g} of {found.unit} cannot be read", found.text, fix))
    return found.plain or None


def checked_unit(unit: str) -> str:
    """`unit`, where it is a unit of acceleration. Raises FileError with a list of these units otherwise."""
    written = unit_names.read(unit)
    if written.dimension != "acceleration" or not written.plain:
        raise FileError(Issue("unit", written.problem or "is not a unit of acceleration", unit, _CHOICES))
    return written.plain
