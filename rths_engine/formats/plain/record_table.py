"""A record in a table with names: its time column and sample numbers told from its signals, each signal with its unit."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from rths_engine.formats.plain import arranged, blocks, form, headings, peaks, time_columns, timing
from rths_engine.formats.plain.blocks import Block
from rths_engine.formats.plain.form import Line
from rths_engine.formats.plain.header_facts import Facts
from rths_engine.formats.plain.record_time import Step, step_of
from rths_engine.formats.table import Column, Table
from rths_engine.foundation import unit_names
from rths_engine.foundation.errors import FileError, Issue

_MOST_WORDS = 3  # of a name; chosen, see docs/decisions/0023
_OF_TIME = ("time step", "peak", "time of")  # statements that are made anew in the units of ground motions


def of_table(table: Table, facts: Facts) -> Table:
    """The signals of a table with names, each with its unit and with the step of its time column."""
    clocks = [one for one in table.columns if one.quantity == "time"]
    if not clocks and not table.named and arranged.is_time(table.columns[0].values):
        clocks = [table.columns[0]]
    signals = [
        one
        for k, one in enumerate(table.columns)
        if not any(one is clock for clock in clocks) and timing.time_like(one, k, table.named) != "sample number"
    ]
    steps = {one.name: _step(_clock_of(one, clocks), facts, len(table.columns[0].values)) for one in signals}
    found = []
    directions = headings.are_components([headings.name_and_unit(one.name)[0] for one in signals])
    confirmed = peaks.confirmed_unit([one.values for one in signals], facts)
    for column in signals:
        name, own = headings.name_and_unit(column.name)
        written = unit_names.read(column.unit or own)
        quantity = "" if directions and written.none else headings.quantity_of(name, column.unit or own)
        if written.none and quantity in {"", headings.BY_DIMENSION.get(facts.unit.dimension, "acceleration")}:
            written = confirmed if facts.unit.none else facts.unit
        step = steps[column.name]
        found.append(with_unit(replace(column, dt=step.dt, start=step.start, time=""), written, quantity))
    stated = [one for one in table.statements if not one.what.startswith(_OF_TIME)]
    of_steps = [one for step in steps.values() for one in step.statements]
    every = (*dict.fromkeys(of_steps), *stated, *peaks.statements(found, facts))
    notes = dict.fromkeys([*table.notes, *(one for step in steps.values() for one in step.notes)])
    return replace(table, format="plain columns", columns=tuple(found), statements=every, notes=tuple(notes))


def _clock_of(column: Column, clocks: Sequence[Column]) -> Column | None:
    """The time column of a signal. Raises FileError where the table has several clocks and assigns none of them to it."""
    if column.time:
        return next(one for one in clocks if one.name == column.time)
    other = next((one for one in clocks[1:] if not time_columns.same(clocks[0], one)), None)
    if other is not None:
        problem = f"has two time columns with other times, {clocks[0].name} and {other.name}: which is that of {column.name}?"
        fix = "put each time column left of its signals, or give each component in a file of its own"
        raise FileError(Issue("file", problem, fix=fix))
    return clocks[0] if clocks else None


def _step(clock: Column | None, facts: Facts, count: int) -> Step:
    return step_of(clock.values if clock else None, facts, lambda k: k + 1, count, clock)


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
    bare = [name for (name, _), _ in pairs]
    timed = bool(bare) and headings.quantity_of(bare[0]) in {"time", "sample number"}
    if timed and headings.are_components(bare[1:]):
        return True
    if timed and separator == "," and all(len(name.split()) <= _MOST_WORDS for name in bare):
        return True  # `Time (s),Ground,Roof`: a sentence does not begin with the word time, cut by commas
    known = sum(
        bool(headings.quantity_of(name, unit or own) or unit or own or blocks.component_in(name)) for (name, own), unit in pairs
    )
    return bool(pairs) and (separator in {";", "\t"} or known == len(pairs) or (separator == "," and 2 * known >= len(pairs)))
