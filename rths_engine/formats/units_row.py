"""Whether a row of text below the names of the columns holds their units."""

from __future__ import annotations

from collections.abc import Sequence

from rths_engine.foundation import unit_names


def is_units_row(fields: Sequence[str]) -> bool:
    """Whether the fields are units. One unknown unit among known units does not make the row a row of names.

    Every filled field names a unit; or at least half of them do, and one of these has two letters or more. `t, x, v, f` are
    names.
    """
    filled = [field for field in fields if not unit_names.read(field).none]
    units = [field for field in filled if unit_names.read(field).unit]
    if not units or len(units) == len(filled):
        return len(units) == len(filled)
    return 2 * len(units) >= len(filled) and any(len(field.strip("()[]{} ")) > 1 for field in units)


def evidence(fields: Sequence[str]) -> str:
    """Which fields made the row a row of units, where not every field is a known unit; else empty."""
    unknown = [read.text for field in fields if (read := unit_names.read(field)).problem]
    if not unknown:
        return ""
    known = [read.text for field in fields if (read := unit_names.read(field)).unit]
    return f"the row below the names holds units, because of {', '.join(known)}; not known: {', '.join(unknown)}"
