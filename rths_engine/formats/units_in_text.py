"""Acceleration units as they are written in headers."""

from __future__ import annotations

import re

from rths_engine.foundation import units
from rths_engine.foundation.errors import FileError, Issue

ACCELERATION_UNITS = tuple(name for name, (dimension, _) in units.UNITS.items() if dimension == "acceleration")

_PER_SECOND_SQUARED = r"\s*/\s*s(?:ec)?\s*(?:\^|\*\*)?\s*(?:2|²)|\s*/\s*s(?:ec)?\s*/\s*s(?:ec)?"
_WRITTEN = (
    ("cm/s^2", re.compile(rf"\bcm(?:{_PER_SECOND_SQUARED})(?![a-z])|\bgals?\b", re.IGNORECASE)),
    ("mm/s^2", re.compile(rf"\bmm(?:{_PER_SECOND_SQUARED})(?![a-z])", re.IGNORECASE)),
    ("in/s^2", re.compile(rf"\bin(?:{_PER_SECOND_SQUARED})(?![a-z])", re.IGNORECASE)),
    ("m/s^2", re.compile(rf"(?<![a-z])m(?:{_PER_SECOND_SQUARED})(?![a-z])", re.IGNORECASE)),
    ("g", re.compile(r"[(\[]\s*g(?:'s)?\s*[)\]]|\bunits?\s*(?:of|in|are|[:=])*\s*g(?:'s)?\b|\bin g\b", re.IGNORECASE)),
)


def unit_in(text: str) -> str | None:
    """The acceleration unit that `text` names; None where it names no unit or several units."""
    found = [unit for unit, pattern in _WRITTEN if pattern.search(text)]
    return found[0] if len(found) == 1 else None


def checked_unit(unit: str) -> str:
    """`unit`, where it is a unit of acceleration. Raises FileError with a list of these units otherwise."""
    plain = units.named(unit)
    if plain is None or plain not in ACCELERATION_UNITS:
        fix = "choose one of " + ", ".join(ACCELERATION_UNITS)
        raise FileError(Issue("unit", "is not a unit of acceleration", unit, fix))
    return plain
