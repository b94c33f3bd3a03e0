"""Plain columns: acceleration only (one or several values a line), or time and one or more channels of acceleration.

Tab, semicolon, comma or space separates the fields. Comment and header lines can come first and can state step and unit.
Components can stand side by side; blocks, such as acceleration and velocity, one after another.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace

from rths_engine.formats import statement
from rths_engine.formats.format import Format
from rths_engine.formats.plain import (
    arranged,
    blocks,
    columns,
    count_line,
    header_facts,
    headings,
    markers,
    peaks,
    transposed,
)
from rths_engine.formats.plain.blocks import Block
from rths_engine.formats.plain.form import Line
from rths_engine.formats.plain.header_facts import Facts
from rths_engine.formats.plain.record_numbers import rows_of
from rths_engine.formats.plain.record_table import has_names, named_header, of_table, with_unit
from rths_engine.formats.plain.record_time import Step, step_of
from rths_engine.formats.source import Source
from rths_engine.formats.statement import Statement
from rths_engine.formats.table import Column, Table, distinct
from rths_engine.foundation import unit_names
from rths_engine.foundation.errors import FileError, Issue

_OF_BLOCK = {"velocity", "displacement"}


@dataclass
class _Read:
    """Columns with what was stated and noted about them."""

    columns: list[Column]
    statements: list[Statement]
    notes: list[str]
    named: bool = False


def looks_like(source: Source) -> bool:
    """Whether most lines, apart from comments, contain only numbers."""
    texts = [text for line in source.head_lines if (text := line.strip())]
    return 2 * sum(blocks.is_numbers(text) for text in texts) > len(texts)


def read(source: Source) -> Table:
    """The record in a text. Raises FileError with the line where its numbers break off."""
    lines = list(enumerate(source.lines, start=1))
    if len(lines) <= transposed.MOST_LINES and (rows := transposed.read(lines)) is not None:
        return of_table(columns.read(source), _facts(rows[0]))
    try:
        found = _joined(blocks.split(lines))
    except FileError:
        if (named := named_header(lines)) is not None:
            return of_table(columns.read(source), _facts(named))
        raise
    if len(found) == 1 and has_names(found[0]):
        return of_table(columns.read(source), _facts(found[0].header))
    first = _facts(found[0].header)
    read_blocks = [_block(one, first if k == 0 else _inherited(one, first), k, len(found)) for k, one in enumerate(found)]
    every = [column for one in read_blocks for column in one.columns]
    stated = peaks.statements(every, first)
    return Table(
        "plain columns",
        distinct(every),
        named=any(one.named for one in read_blocks),
        notes=tuple(note for one in read_blocks for note in one.notes),
        statements=(*stated, *(one for block in read_blocks for one in block.statements)),
        header="\n".join(text for block in found for _, text in block.header),
    )


def _facts(header: Sequence[Line]) -> Facts:
    """The facts of a header. Raises FileError for a factor of which it does not state whether the samples contain it."""
    facts = header_facts.read(header)
    if facts.factors:
        where, text = facts.factors[0]
        fix = "apply the factor to the samples if they do not contain it yet, and remove it from the header"
        raise FileError(Issue(where, "states a factor, and not whether the samples contain it", text, fix))
    return facts


def _inherited(block: Block, first: Facts) -> Facts:
    """The facts of a later block; those of the file where the block does not state its own."""
    own = _facts(block.header)
    if own.steps and first.steps:
        first = replace(first, durations=())
    quantity = _unit_and_quantity(block, own)[1]
    return replace(
        own,
        units=first.units if not own.units and (quantity not in _OF_BLOCK or len(first.units) > 1) else own.units,
        steps=own.steps or first.steps,
        counts=own.counts or (() if own.steps and not first.counts else first.counts),
        durations=own.durations or first.durations,
        missing=(*own.missing, *first.missing),
        width=own.width or first.width,
    )


def _block(block: Block, facts: Facts, index: int, of: int) -> _Read:
    rows, texts = rows_of(block.rows, facts.width)
    rows, texts, facts = _without_count(rows, texts, facts, block)
    single = sum(blocks.components_in(text) for _, text in block.header) == 1 and len(facts.components) < 2
    found = arranged.arranged(rows, texts, facts, single)
    step = step_of(found.times, facts, found.line, len(next(iter(found.signals.values()))))
    for name, values in found.signals.items():
        markers.refuse(values, name, found.line, facts.missing)
    written, quantity = _unit_and_quantity(block, facts)
    if written.none:
        written = peaks.confirmed_unit(found.signals.values(), facts)
    signals = [Column(name, values, dt=step.dt, start=step.start) for name, values in found.signals.items()]
    listed = _listed(facts, len(signals), index, of)
    columns = [with_unit(one, unit, "") for one, unit in zip(signals, listed, strict=True)] if listed else []
    columns = columns or [with_unit(one, written, quantity) for one in signals]
    statements = _statements(facts, found, step, len(rows))
    notes = [*step.notes, *([found.note] if found.note else []), *(f"{one}: not used" for one in facts.unclear)]
    if of == 1:
        return _Read(columns, statements, notes, found.named)
    title = _title(block, index)
    several = len(columns) > 1
    columns = [replace(one, name=f"{title} {one.name}" if several else title) for one in columns]
    return _Read(columns, [*statements, *(peaks.statements(columns, facts) if index else [])], notes, True)


def _listed(facts: Facts, signals: int, index: int, of: int) -> tuple[unit_names.Written, ...]:
    """The unit of each signal where the header lists one for each column, or for each block; else empty."""
    if len(facts.units) < 2:
        return ()
    if len(facts.units) == signals:
        return facts.units
    return (facts.units[index],) * signals if len(facts.units) == of else ()


def _statements(facts: Facts, found: arranged.Arranged, step: Step, rows: int) -> list[Statement]:
    """Count and duration in the header beside the samples. Either count agrees where the arrangement is not clear."""
    lengths = {len(values) for values in found.signals.values()}
    stated = [
        statement.count(round(one.value), min(lengths, key=lambda n: abs(n - one.value)), one.where) for one in facts.counts
    ]
    if step.dt is not None:
        stated += facts.duration_statements(max(lengths), step.dt, step.start)
    return [*step.statements, *stated]


def _without_count(
    rows: list[arranged.Row], texts: list[str], facts: Facts, block: Block
) -> tuple[list[arranged.Row], list[str], Facts]:
    """The rows of samples, and the facts with those of a line above them that states their count. Raises FileError."""
    rest = sum(len(row) for _, row in rows[1:])
    counted = {len(rows) - 1, rest}
    last = block.header[-1:]
    if last and (above := count_line.parsed(last[0])) is not None:
        if above.count not in {len(rows), rest + len(rows[0][1])}:
            raise count_line.refusal(last[0], rest + len(rows[0][1]))
        return rows, texts, count_line.added(facts, above)
    line = (rows[0][0], texts[0])
    found = count_line.parsed(line)
    whole = [k for k, text in enumerate(texts) if re.fullmatch(r"\s*[1-9]\d+\.?\s*", text)]
    decimals = sum("." in text or "," in text for text in texts[1:]) > 0.9 * (len(texts) - 1)
    several = len(rows) > 2 or (len(rows) == 2 and found is not None and found.step is not None)
    if several and found is not None and (found.count in counted) and (decimals or len(rows[0][1]) != len(rows[1][1])):
        return rows[1:], texts[1:], count_line.added(facts, found)
    if len(rows) > 2 and (
        len(rows[0][1]) != len(rows[1][1]) == len(rows[2][1]) or (whole[:1] == [0] and decimals and len(whole) < 3)
    ):
        raise count_line.refusal(line, rest)
    if decimals and 0 < len(whole) < 3 and len(rows) > 8:
        k = whole[0]
        raise count_line.refusal((rows[k][0], texts[k]), sum(len(row) for _, row in rows[k + 1 :]))
    return rows, texts, facts


def _unit_and_quantity(block: Block, facts: Facts) -> tuple[unit_names.Written, str]:
    """The unit of the values, and their quantity where the header names velocity or displacement alone."""
    named = {found for _, text in block.header if (found := headings.quantity_in(text)) in {"acceleration", *_OF_BLOCK}}
    quantity = next(iter(named)) if len(named) == 1 else ""
    if not facts.unit.none:
        return facts.unit, quantity
    for _, text in block.header:
        unit = headings.name_and_unit(re.sub(r"^[#%!/\s]+", "", text))[1]
        written = unit_names.read(unit)
        if written.unit and written.dimension in headings.BY_DIMENSION:
            return written, quantity
    return facts.unit, quantity if quantity in _OF_BLOCK else ""


def _title(block: Block, index: int) -> str:
    """The name of a block: its component and quantity, else its lines."""
    words = " ".join(text for _, text in block.header)
    parts = [blocks.component_in(words), next((q for _, text in block.header if (q := headings.quantity_in(text))), "")]
    return " ".join(part for part in parts if part) or f"block {index + 1} (lines {block.rows[0][0]} to {block.rows[-1][0]})"


def _joined(found: list[Block]) -> list[Block]:
    """The blocks; those that only blank lines part are one where the header states the count of all their numbers."""
    stated = {round(one.value) for one in header_facts.read(found[0].header).counts}
    rows = [row for one in found for row in one.rows]
    if len(found) > 1 and all(one.apart for one in found[1:]) and blocks.count(rows) in stated:
        return [Block(found[0].header, rows)]
    return found


FORMAT = Format(
    key="record",
    title="Plain text of one record",
    of="ground motion",
    extensions=("txt", "csv", "dat", "acc"),
    defined="acceleration alone, time and acceleration, components side by side, blocks one after another",
    header="in several languages: number of samples, step or sampling rate, units, duration, start and end, largest and "
    "smallest values and their times, components, marks of missing values, Fortran format",
    compared="number of samples, step of the time column, duration, start and end, units stated twice, largest and smallest "
    "value of each component and its time; a factor is refused",
    looks_like=looks_like,
    read=read,
    public=4,
    public_check="every sample and the step by a parser of a few lines",
)
