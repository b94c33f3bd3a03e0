"""Columns of text beside columns of numbers: dates and clocks become seconds, other text is left out and named."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from rths_engine.formats import dates
from rths_engine.formats.lines import decoded
from rths_engine.formats.numeric_block import line_number
from rths_engine.formats.plain.form import Form
from rths_engine.formats.source import Source
from rths_engine.formats.table import Column
from rths_engine.foundation.errors import FileError, Issue

_TRIED = 20  # rows by which a column of stamps is recognised; chosen, see docs/decisions/0023


@dataclass(frozen=True)
class TextColumns:
    """Time columns by the index of their field, and a note for each column of text that is not used."""

    times: dict[int, Column]
    notes: tuple[str, ...]


def read(
    source: Source, start: int, form: Form, numeric: Sequence[bool], names: Sequence[str], first: Sequence[Sequence[str]]
) -> TextColumns:
    """The stamps in the columns of text; `first`: the first rows. Raises FileError for a stamp that is not valid."""
    of_text = [k for k, holds in enumerate(numeric) if not holds]
    for k in of_text:
        _refuse_other_decimal(source, start, form, names[k], first[0][k])
    days = {k for k in of_text if all(dates.is_day(row[k]) for row in first[:_TRIED])}
    clocks = {k for k in of_text if all(dates.is_stamp(row[k]) for row in first[:_TRIED])}
    used = {k: k - 1 if k - 1 in days else None for k in clocks}
    times: dict[int, Column] = {}
    notes: list[str] = []
    if used:
        texts_of_rows, lines = [], []
        for at, fields in rows(source, start, form):
            texts_of_rows.append([" ".join(fields[one] for one in (day, k) if one is not None) for k, day in used.items()])
            lines.append(at)
        for k, texts in zip(used, zip(*texts_of_rows, strict=True), strict=True):
            found = dates.seconds(texts, lines)
            if len(found.seconds) > 1 and not (found.seconds[1:] > found.seconds[:-1]).all():
                notes.append(f"{names[k]} holds stamps that do not increase, written to {found.resolution:g} s: not used")
                continue
            times[k] = Column(names[k], found.seconds, "s", quantity="time", applied="seconds from the first stamp")
    with_clock = {day for day in used.values() if day is not None}
    notes += [f"{names[k]} holds text" for k in of_text if k not in used and k not in with_clock]
    return TextColumns(times, tuple(notes))


def _refuse_other_decimal(source: Source, start: int, form: Form, name: str, field: str) -> None:
    """Raises FileError for a number that has another decimal sign than the other columns."""
    if re.fullmatch(r"[-+]?[\d.,'\u2019\u00a0]*\d[\d.,]*(?:[eEdD][-+]?\d+)?", field) and not dates.is_day(field):
        problem = f"{name} is not written with the decimal sign {form.decimal!r} of the other columns"
        raise FileError(Issue(f"line {line_number(source, start)}", problem, field, "write all numbers with a decimal point"))


def rows(source: Source, start: int, form: Form) -> Iterator[tuple[int, list[str]]]:
    """Line number and fields of each row from byte `start`."""
    number = line_number(source, start)
    with source.open() as file:
        file.seek(start)
        for at, line in enumerate(file.read().splitlines(), start=number):
            if (text := decoded(line)).strip():
                yield at, form.fields(text)
