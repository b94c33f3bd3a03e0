"""Text columns: CSV, TSV or white space, with or without a header and a row of units, with a decimal point or comma."""

from __future__ import annotations

import csv
import re
from dataclasses import dataclass
from functools import partial
from itertools import pairwise

import numpy as np

from rths_engine.formats import units_row
from rths_engine.formats.format import Format
from rths_engine.formats.lines import check_text, decoded, value
from rths_engine.formats.numeric_block import Layout, line_number, read_block
from rths_engine.formats.plain.record import header_step
from rths_engine.formats.source import Source
from rths_engine.formats.table import Column, Table, distinct
from rths_engine.foundation import unit_names
from rths_engine.foundation.errors import FileError, Issue

# chosen; see docs/decisions/0023
_COMMENT = re.compile(r"[#%!]+|//")
_MISSING = {"", "na", "n/a", "nan", "null", "none", "-", "--", "#n/a", "nil"}
_LOOKED_AT = 60  # lines used to determine the separator
LOOKED_INTO = 1 << 20  # bytes: the header is in the first; the lines that determine the separator are in the middle of the file
_CANDIDATES = ((";", "."), (";", ","), ("\t", "."), ("\t", ","), (",", "."), ("", "."), ("", ","))
MOST_FIELDS = 1000


@dataclass(frozen=True, slots=True)
class Form:
    """The `separator` (empty: white space) and the decimal sign of a text file."""

    separator: str
    decimal: str

    def fields(self, line: str) -> list[str]:
        if not self.separator:
            return line.split()
        if '"' in line:
            return [field.strip() for field in next(csv.reader([line], delimiter=self.separator, skipinitialspace=True))]
        return [field.strip() for field in line.split(self.separator)]

    def number(self, field: str) -> float | None:
        """The number in a field: NaN for a missing value, None where the field is not a number."""
        if field.lower() in _MISSING:
            return float("nan")
        if "_" in field or (self.decimal == "," and "." in field):
            return None
        return value(field.replace(",", ".") if self.decimal == "," else field)


Line = tuple[int, str]  # byte at which the line starts, and the line


def read(source: Source) -> Table:
    """Read the columns of a text. Raises FileError with the line that differs from the others."""
    filled = _filled(source, 0, LOOKED_INTO)
    plain = [(at, text) for at, text in filled if not _COMMENT.match(text.lstrip())]
    if not plain:
        raise FileError(Issue("file", "contains no numbers", fix="choose a file of measurements"))
    whole = source.size <= LOOKED_INTO
    sample = plain if whole else _filled(source, source.size // 2, LOOKED_INTO)
    if ending := _ending(sample[-_LOOKED_AT:]):
        filled, plain, sample = (_without(ending, lines) for lines in (filled, plain, sample))
    form, numeric = _form(source, sample[len(sample) // 2 :][:_LOOKED_AT])
    first = _first(plain, form, numeric)
    header = [text for at, text in filled if at < plain[first][0]]
    names, units = _heading(header, form, len(numeric))
    _refuse_ambiguous(source, plain[first:], form, names)
    layout = Layout(form.separator, form.decimal, numeric, bool(ending))
    values = read_block(source, plain[first][0], layout, partial(_other_line, source, form, numeric, ending))
    dt = header_step(header)
    used = [k for k, holds in enumerate(numeric) if holds]
    columns = [Column(names[k] if names else f"column {k + 1}", values[j], units[k], dt) for j, k in enumerate(used)]
    left = tuple(f"{names[k] if names else f'column {k + 1}'} holds text" for k, holds in enumerate(numeric) if not holds)
    notes = (*left, evidence) if (evidence := units_row.evidence(units)) else left
    return Table("columns of text", distinct(columns), named=bool(names), notes=notes)


def _filled(source: Source, start: int, size: int) -> list[Line]:
    """The lines that are not empty in a part of the file; only whole lines."""
    raw = source.part(start, size)
    check_text(raw)
    found: list[Line] = []
    at = start
    lines = raw.splitlines(keepends=True)
    if start + size < source.size:
        lines.pop()
    for number, line in enumerate(lines):
        if (text := decoded(line)).strip() and (number or not start):
            found.append((at, text))
        at += len(line)
    return found


def _ending(lines: list[Line]) -> str:
    """The separator with which all lines end; empty where they do not."""
    ending = lines[-1][1][-1] if lines else ""
    return ending if ending and ending in ";,\t" and all(text.endswith(ending) for _, text in lines) else ""


def _without(ending: str, lines: list[Line]) -> list[Line]:
    return [(at, text.removesuffix(ending)) for at, text in lines]


def _form(source: Source, lines: list[Line]) -> tuple[Form, list[bool]]:
    """The form for which most columns are numbers, and whether each column is numeric."""
    best: tuple[tuple[int, int], Form, list[bool]] | None = None
    for form in (Form(*candidate) for candidate in _CANDIDATES):
        rows = [form.fields(text) for _, text in lines]
        width = max(set(map(len, rows)), key=[len(row) for row in rows].count)
        if width > MOST_FIELDS or 2 * sum(len(row) == width for row in rows) <= len(rows):
            continue
        kept = [row for row in rows if len(row) == width]
        numeric = [2 * sum(form.number(row[k]) is not None for row in kept) > len(kept) for k in range(width)]
        score = (-(width - sum(numeric)), sum(numeric))
        if any(numeric) and (best is None or score > best[0]):
            best = score, form, numeric
    if best is None:
        at, line = lines[0]
        fix = "write one row of numbers for each time, separated by comma, semicolon, tab or space"
        raise FileError(Issue(f"line {line_number(source, at)}", "is not a row of numbers", line, fix))
    return best[1], best[2]


def _first(lines: list[Line], form: Form, numeric: list[bool]) -> int:
    """Index of the first row of numbers."""
    for index, (_, text) in enumerate(lines):
        fields = form.fields(text)
        numbers = [form.number(field) for field, holds in zip(fields, numeric, strict=False) if holds]
        if len(fields) == len(numeric) and None not in numbers and not np.isnan(np.array(numbers, dtype=float)).all():
            return index
    raise FileError(Issue("file", "contains no complete row of numbers", fix="correct the rows or the separator"))


def _heading(header: list[str], form: Form, width: int) -> tuple[list[str], list[str]]:
    """Names and units of the columns, from the last lines before the numbers; no names where no line fits."""
    rows = [form.fields(_COMMENT.sub("", text, count=1).strip() if _COMMENT.match(text) else text) for text in header]
    fitting = [row for row in rows if len(row) == width and any(form.number(field) is None for field in row)]
    if not fitting:
        return [], [""] * width
    for above, below in pairwise(fitting[-2:]):
        if units_row.is_units_row(below):
            return above, [unit_names.read(field).text for field in below]
    return [name or f"column {k}" for k, name in enumerate(fitting[-1], start=1)], [""] * width


def _refuse_ambiguous(source: Source, lines: list[Line], form: Form, names: list[str]) -> None:
    if form.separator == "," and not names and all(re.fullmatch(r"[-+]?\d+,\d+", text) for _, text in lines[:_LOOKED_AT]):
        at, line = lines[0]
        fix = "write numbers with a decimal point, or name the columns in a first line"
        raise FileError(Issue(f"line {line_number(source, at)}", "the comma can be a decimal sign or a separator", line, fix))


def _other_line(source: Source, form: Form, numeric: list[bool], ending: str, at: int, raw: bytes) -> list[float] | None:
    """The numbers of a line that is not written as plain numbers, such as one with `n/a`; None for an empty line."""
    text = decoded(raw).removesuffix(ending)
    if not text.strip():
        return None
    if _COMMENT.match(text.lstrip()):
        raise _refused(source, at, "is a comment between rows of numbers", text)
    fields = form.fields(text)
    if len(fields) != len(numeric):
        raise _refused(source, at, f"has {len(fields)} fields; the others have {len(numeric)}", text)
    numbers: list[float] = []
    for k, (field, holds) in enumerate(zip(fields, numeric, strict=True)):
        if holds and (number := form.number(field)) is not None:
            numbers.append(number)
        elif holds:
            raise _refused(source, at, f"column {k + 1} is not a number", field)
    return numbers


def _refused(source: Source, at: int, problem: str, text: str) -> FileError:
    return FileError(Issue(f"line {line_number(source, at)}", problem, text, "correct or remove the line"))


FORMAT = Format(
    key="columns",
    title="Columns of text (CSV, TSV, white space)",
    of="measurement",
    extensions=("csv", "tsv", "txt", "dat"),
    defined="RFC 4180 and its habitual variants",
    header="names, a row of units, time step or sampling rate",
    compared="number of fields in every row",
    looks_like=lambda source: bool(source.head_lines),
    read=read,
)
