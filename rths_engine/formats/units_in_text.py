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
_FACTOR = r"(?:(?:\d+\.?\d*|\.\d+)?(?:e[-+]?\d+|\s*[*x]?\s*10\s*(?:\^|\*\*)?\s*[-+]?\d+)?\s*[*x]?\s*)"
_LENGTHS = r"(?:[cm]?m|in|ft)"
_PHRASES = (
    re.compile(rf"(?<![a-z])({_LENGTHS}{_PER_SECOND_SQUARED})(?![a-z])", re.IGNORECASE),
    re.compile(r"(?<![a-z])(gals?)(?![a-z])", re.IGNORECASE),
    re.compile(rf"[(\[]\s*({_FACTOR}m?g(?:'s)?(?:\s*/\s*10+)?)\s*[)\]]", re.IGNORECASE),
    re.compile(
        rf"\b(?:units?\s*(?:of|in|are|is|[:=]|\s)*|in\s+(?:units?\s+of\s+)?)({_FACTOR}m?g(?:'s)?(?:\s*/\s*10+)?)(?![\w/%])",
        re.IGNORECASE,
    ),
)


def acceleration_in(text: str) -> Written:
    """The unit of acceleration in a sentence. It states none where the text names none, or several different units."""
    found: dict[float | str, Written] = {}
    for pattern in _PHRASES:
        for match in pattern.finditer(text):
            written = unit_names.read(match[1])
            if written.none or (written.unit and written.dimension != "acceleration"):
                continue
            found.setdefault(written.scale * units.factor(written.unit) if written.unit else written.text, written)
    return next(iter(found.values())) if len(found) == 1 else Written("")


def unit_in(text: str) -> str | None:
    """The acceleration unit that `text` names; None where it names no unit or several units.

    Raises FileError where the unit in the text is not known, or is scaled by a number that no unit of the table has.
    """
    found = acceleration_in(text)
    if found.problem:
        raise FileError(Issue("unit", found.problem, found.text, _CHOICES))
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
