"""A record in a table with names: its time column and sample numbers told from its signals, each signal with its unit."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from rths_engine.formats.plain import arranged, blocks, form, headings, peaks, timing
from rths_engine.formats.plain.blocks import Block
from rths_engine.formats.plain.form import Line
from rths_engine.formats.plain.header_facts import Facts
from rths_engine.formats.plain.record_time import step_of
from rths_engine.formats.table import Column, Table
from rths_engine.foundation import unit_names
from rths_engine.foundation.errors import FileError

_OF_TIME = ("time step", "peak", "time of")  # statements that are made anew in the units of ground motions


def of_table(table: Table, facts: Facts) -> Table:
    """The signals of a table with names, each with its unit and with the step of its time column."""
    time = next((one for one in table.columns if one.quantity == "time"), None)
    if time is None and not table.named and arranged.is_time(table.columns[0].values):
        time = table.columns[0]
    signals = [
        one
        for k, one in enumerate(table.columns)
        if one is not time and one.quantity != "time" and timing.time_like(one, k, table.named) != "sample number"
    ]
    step = step_of(time.values if time else None, facts, lambda k: k + 1, len(table.columns[0].values), time)
    found = []
    confirmed = peaks.confirmed_unit([one.values for one in signals], facts)
    for column in signals:
        name, own = headings.name_and_unit(column.name)
        written = unit_names.read(column.unit or own)
        quantity = headings.quantity_of(name, column.unit or own)
        if written.none and quantity in {"", headings.BY_DIMENSION.get(facts.unit.dimension, "acceleration")}:
            written = confirmed if facts.unit.none else facts.unit
        found.append(with_unit(replace(column, dt=step.dt, start=step.start), written, quantity))
    stated = [one for one in table.statements if not one.what.startswith(_OF_TIME)]
    every = (*step.statements, *stated, *peaks.statements(found, facts))
    return replace(table, format="plain columns", columns=tuple(found), statements=every, notes=(*table.notes, *step.notes))


def with_unit(column: Column, written: unit_names.Written, quantity: str = "") -> Column:
    """The column in the unit of the table; a number before the unit is applied. An unknown unit stays as it is written."""
    by_unit = headings.BY_DIMENSION.get(written.dimension, written.dimension)
    if written.unit and written.scale != 1.0:
        applied = f"values x {written.scale:g} {written.unit} ({written.text})"
        return replace(column, values=column.values * written.scale, unit=written.unit, quantity=by_unit, applied=applied)
    return replace(column, unit=written.unit or (written.text if written.problem else ""), quantity=by_unit or quantity)


def named_header(lines: Sequence[Line]) -> list[Line] | None:
    """The header of a text whose rows of numbers hold stamps or words, below names of columns; None for another text."""
    filled = [(at, text.strip()) for at, text in lines if text.strip()]
    try:
        own, numeric = form.detected(filled[len(filled) // 2 :][: form.LOOKED_AT])
    except FileError:
        return None
    if len(numeric) < 2:
        return None
    start = next((k for k, (_, text) in enumerate(filled) if _is_row(own, numeric, text)), 0)
    header = filled[:start]
    return header if _meant(headings.find(header, own, len(numeric)), own.separator) else None


def _is_row(own: form.Form, numeric: Sequence[bool], text: str) -> bool:
    fields = own.fields(text)
    return len(fields) == len(numeric) and all(
        own.number(one) is not None for one, holds in zip(fields, numeric, strict=True) if holds
    )


def has_names(block: Block) -> bool:
    """Whether the header of a block names columns."""
    if not block.header:
        return False
    try:
        own, numeric = form.detected(block.rows[: form.LOOKED_AT])
    except FileError:
        return False
    return len(numeric) > 1 and all(numeric) and _meant(headings.find(block.header, own, len(numeric)), own.separator)


def _meant(heading: headings.Heading, separator: str) -> bool:
    """Whether a row of words names columns.

    Semicolons and tabs separate columns; commas also parts of a sentence, so that half of the words must mean quantities, units
    or components; spaces separate any words, so that all of them must.
    """
    pairs = [(headings.name_and_unit(name), unit) for name, unit in zip(heading.names, heading.units, strict=False)]
    known = sum(
        bool(headings.quantity_of(name, unit or own) or unit or own or blocks.component_in(name)) for (name, own), unit in pairs
    )
    return bool(pairs) and (separator in {";", "\t"} or known == len(pairs) or (separator == "," and 2 * known >= len(pairs)))
