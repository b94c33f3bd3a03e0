"""Names of strong-motion channels: station and direction (`CE23837 360 deg`, `CE23837 up`)."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import replace

from rths_engine.formats.table import Column, distinct

_CHANNEL = re.compile(r"\bCh(?:a|an|annel)?\b\.?:?\s*([\d?]+)\s*:\s*(.*?)\s*(?:\(|\s{2,}|\bLocation\b|$)", re.IGNORECASE)
_DEGREES = re.compile(r"^(\d+)\s*deg(?:rees)?\.?$", re.IGNORECASE)
_WORDS = {"UP", "DOWN", "RADIAL", "TRANSVERSE", "LONG", "TRAN", "VERT"}


def of_channel(text: Iterable[str]) -> str:
    """The direction from `Chan  1: 90 Deg   Location: ...`; empty where no line has this form."""
    for line in text:
        if found := _CHANNEL.search(line):
            return found[2].strip() or (f"channel {found[1]}" if found[1] != "?" else "")
    return ""


def oriented(direction: str) -> str:
    """A direction as it is shown: `90 Deg` -> `90 deg`, `UP` -> `up`."""
    if found := _DEGREES.match(direction):
        return f"{int(found[1])} deg"
    return direction.lower() if direction.upper() in _WORDS else direction


def degrees(direction: str) -> int | None:
    """The azimuth (degrees) of a direction; None for `up` and the like."""
    found = _DEGREES.match(direction)
    return int(found[1]) if found else None


def named_once(columns: Sequence[Column]) -> tuple[Column, ...]:
    """The columns with their quantity in the name where it is not acceleration, and a number where names repeat."""
    named = [replace(one, name=_with_quantity(one)) for one in columns]
    if max(Counter(one.name for one in named).values(), default=0) > 1:
        return distinct(named)
    return tuple(named)


def _with_quantity(column: Column) -> str:
    if not column.name:
        return column.quantity
    return column.name if column.quantity in ("", "acceleration") else f"{column.name} {column.quantity}"
