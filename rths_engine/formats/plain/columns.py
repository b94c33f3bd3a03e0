"""Text columns: CSV, TSV or white space, with or without a header and a row of units, with a decimal point or comma."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import partial

import numpy as np

from rths_engine.formats import dates, units_row
from rths_engine.formats.format import Format
from rths_engine.formats.lines import check_text, decoded
from rths_engine.formats.numeric_block import Layout, line_number, read_block
from rths_engine.formats.plain import (
    count_line,
    form,
    header_facts,
    heading_gains,
    heading_units,
    headings,
    markers,
    peaks,
    text_columns,
    time_columns,
    timing,
    transposed,
)
from rths_engine.formats.plain.form import COMMENT, LOOKED_AT, Form
from rths_engine.formats.plain.header_facts import Facts
from rths_engine.formats.plain.refusals import blank_between, not_a_number, other_width, text_between, touches
from rths_engine.formats.scratch import release
from rths_engine.formats.source import Source
from rths_engine.formats.table import Column, Table, distinct
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import FileError, Issue

# chosen; see docs/decisions/0023
LONG_LINE = 4096  # bytes of a line whose numbers can be a signal
LONGEST_ROWS = 1 << 27  # bytes of a text whose rows are signals
LOOKED_INTO = 1 << 20  # bytes: the header is in the first; the lines that determine the separator are in the middle of the file

Line = tuple[int, str]  # byte at which the line starts, and the line


def read(source: Source) -> Table:
    """Read the columns of a text. Raises FileError with the line that differs from the others."""
    if _few_lines(source) and (rows := transposed.read(list(enumerate(source.lines, start=1)))) is not None:
        return _of_rows(*rows)
    filled = _filled(source, 0, LOOKED_INTO)
    plain = [(at, text) for at, text in filled if not COMMENT.match(text.lstrip())]
    if not plain:
        raise FileError(Issue("file", "contains no numbers", fix="choose a file of measurements"))
    sample = plain if source.size <= LOOKED_INTO else _filled(source, source.size // 2, LOOKED_INTO)
    sample = sample[len(sample) // 2 :][:LOOKED_AT]
    own, numeric = _form(source, sample)
    fields = [found for _, text in sample if len(found := own.fields(text)) == len(numeric)]
    empty = [k for k in range(len(numeric)) if not any(row[k] for row in fields)]
    start = _start(plain, own, numeric)
    header = _numbered(source, [(at, text) for at, text in filled if at < start])
    rows_of_text = [(at, text) for at, text in filled if at >= start]
    heading = headings.find(header, own, len(numeric), empty)
    stated_units = heading_units.settled(heading, header)
    _refuse_numbers_of_columns(source, rows_of_text, own, len(numeric))
    form.refuse_ambiguous([*_numbered(source, rows_of_text[:1]), *rows_of_text[1:]], own, bool(heading.names))
    body = _Body(source, own, numeric, [text for _, text in header])
    values = read_block(source, start, Layout(own.separator, own.decimal, numeric), body.other)
    line = body.line_of_row(start, len(values[0]))
    _refuse_points(source, start, own, rows_of_text[:LOOKED_AT], numeric, values)
    facts = count_line.with_numbers_above(header_facts.read(header), header, len(values[0]), len(numeric))
    names = heading.names or tuple(f"column {k}" for k in range(1, len(numeric) + 1))
    first_rows = [row for _, text in rows_of_text[:LOOKED_AT] if len(row := own.fields(text)) == len(numeric)]
    texts = text_columns.read(source, start, own, numeric, names, first_rows)
    left = {k for k in empty if not heading.names or names[k] == f"column {k + 1}"}
    numbers = iter(values)
    columns = [
        texts.times[k] if k in texts.times else _column(names[k], next(numbers), stated_units[k])
        for k, holds in enumerate(numeric)
        if holds or k in texts.times
    ]
    columns = [one for one in columns if one.name not in {names[k] for k in left}]
    columns = heading_gains.applied(columns, header)
    used = [one.applied for one in columns]
    scaled = [
        f"{where} states '{text}': not applied" for where, text in facts.factors if not any(f"({where}:" in one for one in used)
    ]
    notes = [*texts.notes, *scaled, *(one for one in (heading.note, units_row.evidence(heading.units)) if one)]
    return _table(columns, facts, header, bool(heading.names), notes, line)


def _table(
    columns: Sequence[Column],
    facts: Facts,
    header: Sequence[Line],
    named: bool,
    notes: Sequence[str],
    line: Callable[[int], int],
) -> Table:
    for column in columns:
        markers.refuse(column.values, column.name, line, facts.missing)
        release(column.values)
    done = timing.timed(columns, facts, line, named)
    time_columns.refuse_untimed(done.columns, line)
    others = sum(timing.time_like(one, k, named) != "" or one.quantity == "time" for k, one in enumerate(done.columns))
    return Table(
        "columns of text",
        time_columns.assigned(distinct(done.columns)),
        named=named,
        notes=(*notes, *done.notes),
        statements=(
            *done.statements,
            *peaks.statements(done.columns, facts),
            *facts.channel_statements(len(done.columns) - others, others),
        ),
        header="\n".join(text for _, text in header),
    )


def _of_rows(header: Sequence[Line], signals: Sequence[transposed.Signal]) -> Table:
    """The table of a text whose rows are signals."""
    columns = [Column(one.name or f"row {k}", one.values, one.unit) for k, one in enumerate(signals, start=1)]
    named = all(one.name for one in signals)
    notes = ["each row of the file is a signal"]
    return _table(columns, header_facts.read(header), header, named, notes, lambda _: signals[0].line)


def _column(name: str, values: Array, unit: str) -> Column:
    """A column of numbers; the dates that a spreadsheet counts in days become seconds."""
    seconds = dates.from_days(name, values)
    if seconds is not None:
        return Column(name, seconds, "s", quantity="time", applied="seconds from the first date, which is in days")
    return Column(name, values, unit or headings.name_and_unit(name)[1])


@dataclass
class _Body:
    """The rows of numbers: what the compiled reader does not read, and where blank lines are."""

    source: Source
    form: Form
    numeric: Sequence[bool]
    header: Sequence[str]
    blank: list[int] = field(default_factory=list)

    def other(self, at: int, raw: bytes) -> list[float] | None:
        """The numbers of a line that is not written as plain numbers; None for an empty line. Raises FileError otherwise."""
        text = decoded(raw)
        if not text.strip():
            self.blank.append(at)
            return None
        fields = self.form.fields(text)
        number = partial(line_number, self.source, at)
        if COMMENT.match(text.lstrip()) or not any(self.form.number(one) is not None for one in fields if one):
            after = [one for _, one in _filled(self.source, at, LOOKED_INTO)[1:]]
            raise text_between((number(), text), after, self.header)
        if len(fields) != len(self.numeric):
            glued = next((one for one in fields if self.form.number(one) is None and touches(one)), None)
            raise not_a_number(number(), glued) if glued else other_width(number(), text, len(fields), len(self.numeric))
        found: list[float] = []
        for k, (one, holds) in enumerate(zip(fields, self.numeric, strict=True), start=1):
            if not holds:
                continue
            value = self.form.number(one)
            if value is None:
                raise not_a_number(number(), one, f"column {k} is not a number")
            if np.isinf(value):
                fix = "leave the field empty where the value is missing, or leave the column out"
                raise FileError(Issue(f"line {number()}", f"column {k} is infinite", one, fix))
            found.append(value)
        return found

    def line_of_row(self, start: int, rows: int) -> Callable[[int], int]:
        """The line number of a row. Raises FileError for a blank line between rows, unless there is one after every row."""
        first = line_number(self.source, start)
        end = _end(self.source)
        inside = sorted(at for at in self.blank if at < end)
        if inside and len(inside) < rows - 1:
            raise blank_between(line_number(self.source, inside[0]) + 1)
        return lambda row: first + row * (2 if inside else 1)


def _end(source: Source) -> int:
    """The byte after the last text of the file."""
    size = source.size
    while size > 0:
        part = source.part(max(0, size - LOOKED_INTO), min(size, LOOKED_INTO))
        if kept := part.rstrip(b" \t\r\n\x1a,;"):
            return size - len(part) + len(kept)
        size -= len(part)
    return 0


def _few_lines(source: Source) -> bool:
    """Whether the rows of the text can be signals: it is short, or its first bytes end within a long line."""
    ends = source.head.count(b"\n") + source.head.count(b"\r")
    rest = len(source.head) - 1 - max(source.head.rfind(b"\n"), source.head.rfind(b"\r"))
    return (
        ends <= transposed.MOST_LINES and (source.size <= len(source.head) or rest > LONG_LINE) and source.size <= LONGEST_ROWS
    )


def _form(source: Source, sample: Sequence[Line]) -> tuple[Form, list[bool]]:
    """The form of the lines and which columns are numbers. Raises FileError with the line number of the first line."""
    try:
        return form.detected(sample)
    except FileError:
        return form.detected([*_numbered(source, sample[:1]), *sample[1:]])


def _numbered(source: Source, lines: Sequence[Line]) -> list[Line]:
    """The lines with their line numbers in place of their bytes."""
    return [(line_number(source, at), text) for at, text in lines]


def _filled(source: Source, start: int, size: int) -> list[Line]:
    """The lines that are not empty in a part of the file; only whole lines, and not the first where it may be cut."""
    raw = source.part(start, size)
    check_text(raw)
    found: list[Line] = []
    at = start
    lines = raw.splitlines(keepends=True)
    if start + size < source.size and len(lines) > 1:
        lines.pop()
    whole = not start or source.part(start - 1, 1) in {b"\n", b"\r"}
    for number, line in enumerate(lines):
        if (text := decoded(line)).strip() and (number or whole):
            found.append((at, text))
        at += len(line)
    return found


def _start(lines: Sequence[Line], own: Form, numeric: Sequence[bool]) -> int:
    """The byte at which the first row of numbers starts; a count above them is no row, also in a row of empty fields."""
    for index, (at, text) in enumerate(lines):
        fields = own.fields(text)
        numbers = [own.number(one) for one, holds in zip(fields, numeric, strict=False) if holds]
        if len(fields) != len(numeric) or None in numbers or np.isnan(np.array(numbers, dtype=float)).all():
            continue
        below = [one for _, one in lines[index + 1 : index + 20]]
        alone = sum(map(bool, fields)) == 1 and any(sum(map(bool, own.fields(one))) > 1 for one in below)
        if count_line.parsed((0, text)) and (alone or (list(numeric) == [True] and any("." in one for one in below))):
            continue
        return at
    raise FileError(Issue("file", "contains no complete row of numbers", fix="correct the rows or the separator"))


def _refuse_numbers_of_columns(source: Source, rows: Sequence[Line], own: Form, width: int) -> None:
    """Raises FileError where the first row counts the columns, so that it can be a heading or a sample."""
    fields = own.fields(rows[0][1])
    if width > 2 and any(fields == [str(k) for k in range(first, first + width)] for first in (0, 1)):
        fix = "remove the line if it numbers the columns"
        raise FileError(
            Issue(f"line {line_number(source, rows[0][0])}", "can number the columns or be a sample", rows[0][1], fix)
        )


def _refuse_points(
    source: Source, start: int, own: Form, first: Sequence[Line], numeric: Sequence[bool], values: Sequence[Array]
) -> None:
    """Raises FileError where a point can separate thousands: `18.719` beside `955`, in a file without other decimals."""
    rows = [row for _, text in first if len(row := own.fields(text)) == len(numeric)]
    of_field = [k for k, holds in enumerate(numeric) if holds]
    pointed = [row[k] for row in rows for k in of_field if "." in row[k]]
    if own.decimal != "." or own.thousands or not all(form.grouped(one, ".") for one in pointed):
        return  # a file has one decimal sign
    for k, column in zip(of_field, values, strict=True):
        whole = column == np.rint(column)
        inside = np.abs(column[np.isfinite(column)])
        if not whole.any() or whole[np.isfinite(column)].all() or ((inside > 0) & (inside < 1)).any():
            continue
        form.refuse_points(text_columns.rows(source, start, own), k)


FORMAT = Format(
    key="columns",
    title="Columns of text (CSV, TSV, white space)",
    of="measurement",
    extensions=("csv", "tsv", "txt", "dat"),
    defined="RFC 4180 and its habitual variants",
    header="names, units in a row or a line, gains, dates and clocks; in several languages: count, time step or sampling rate, "
    "duration, start and end, peaks",
    compared="number of fields in every row, count, step, duration, start and end, units stated twice, peaks, "
    "number of channels",
    looks_like=lambda source: bool(source.head_lines),
    read=read,
    public=39,
    public_check="every number by a parser of a few lines, in files of laboratories without a format of their own",
)
