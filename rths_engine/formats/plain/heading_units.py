"""The units of columns where a header states them several times: in names, in a row of units, in a line `units: kN, mm`."""

from __future__ import annotations

from collections.abc import Sequence

from rths_engine.formats.plain import header_units, headings
from rths_engine.formats.plain.form import Line
from rths_engine.formats.plain.headings import Heading
from rths_engine.foundation import unit_names
from rths_engine.foundation.errors import FileError, Issue

_FIX = "the file contradicts itself: get it again, or correct the header"


def settled(heading: Heading, header: Sequence[Line]) -> tuple[str, ...]:
    """The units of the row of units, and those of a line of units for columns that state none themselves.

    Raises FileError where two places state different units of one dimension for a column.
    """
    found = list(heading.units)
    named = [headings.name_and_unit(name) for name in heading.names] or [("", "")] * len(found)
    for (name, own), cell in zip(named, found, strict=True):
        if not header_units.same(unit_names.read(own), unit_names.read(cell)):
            problem = f"states {own} in the name of {name} and {cell} in the row of units"
            raise FileError(Issue("header", problem, fix=_FIX))
    where, listed = header_units.listed(header)
    if not listed or not heading.names:
        return tuple(found)
    units = [unit_names.read(cell or own) for (_, own), cell in zip(named, found, strict=True)]
    for (name, _), unit in zip(named, units, strict=True):
        others = [one for one in listed if one.dimension == unit.dimension]
        if unit.unit and others and not any(header_units.same(unit, one) for one in others):
            raise FileError(
                Issue(where, f"states the unit {others[0].text}; the heading of {name} states {unit.text}", fix=_FIX)
            )
    quantities = [headings.quantity_of(name, unit.text) for (name, _), unit in zip(named, units, strict=True)]
    signals = [k for k, quantity in enumerate(quantities) if quantity not in {"time", "sample number"}]
    columns = next((each for each in (signals, list(range(len(found)))) if len(each) == len(listed)), [])
    if not columns and len(listed) == 1:
        meant = headings.BY_DIMENSION.get(listed[0].dimension, listed[0].dimension)
        columns = [k for k in signals if quantities[k] == meant]
        listed = listed * len(columns)
    for k, unit in zip(columns, listed, strict=True):
        if units[k].none:
            found[k] = unit.text
    return tuple(found)
