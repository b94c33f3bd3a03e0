"""Plain columns: acceleration only (one or several values a line), or time and one or more channels of acceleration.

Tab, semicolon, comma or space separates the fields. Comment and header lines can come first and can state step and unit.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

import numpy as np

from rths_engine.formats.format import Format
from rths_engine.formats.lines import NUMBER, numbers, value
from rths_engine.formats.source import Source
from rths_engine.formats.table import Column, Table
from rths_engine.formats.units_in_text import unit_in
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import FileError, Issue

# chosen; see docs/decisions/0023
_COMMENT = ("#", "%", "!", "//", '"', "'", ";", "*")
_STEP = re.compile(
    rf"\b(?:dt|delta[ _]?t|time[ _]?step|sampling interval|step)\b\s*(?:\((s|sec|ms)\))?\s*[=:]?\s*({NUMBER})\s*(ms)?",
    re.IGNORECASE,
)
_RATE = re.compile(rf"\b(?:sampling rate|sampling frequency|fs)\b\s*[=:]?\s*({NUMBER})\s*(?:hz|sps|samples)", re.IGNORECASE)
_DECIMAL_COMMA = re.compile(r"[-+]?\d*,\d+(?:[eE][-+]?\d+)?")
_UNIFORM = 0.05  # of a step: time stamps often have few digits

Row = tuple[int, list[float]]


def looks_like(source: Source) -> bool:
    """Whether most lines, apart from comments, contain only numbers."""
    texts = [text for line in source.head_lines if (text := line.strip()) and not text.startswith(_COMMENT)]
    return 2 * sum(_only_numbers(text) for text in texts) > len(texts)


def read(source: Source) -> Table:
    """The record in a file of columns. Raises FileError with the line where the columns break off."""
    lines = source.lines
    header, data = _split(lines)
    rows = _rows(data)
    dt, unit = header_step(header), unit_in(" ".join(header)) or ""
    if dt is None and (listed := _count_and_step(rows)) is not None:
        dt, rows = listed, rows[1:]
    widths = {len(row) for _, row in rows[:-1]} or {len(rows[0][1])}
    if len(widths) == 1 and widths != {1} and len(rows[-1][1]) in widths and _is_time(table := np.array([r for _, r in rows])):
        columns = _timed(table, rows, dt, unit)
    else:
        columns = (Column("acceleration", np.array([number for _, row in rows for number in row]), unit, dt),)
    return Table("plain columns", columns, named=False, header="\n".join(header))


def _timed(table: Array, rows: Sequence[Row], header_dt: float | None, unit: str) -> tuple[Column, ...]:
    dt = _uniform_step(table[:, 0], rows)
    if header_dt is not None and abs(header_dt / dt - 1) > _UNIFORM:
        raise FileError(Issue("dt", f"the header says {header_dt:g} s, the time column {dt:g} s", fix="correct one of them"))
    return tuple(Column(f"column {k + 1}", table[:, k], unit, dt) for k in range(1, table.shape[1]))


def _split(lines: list[str]) -> tuple[list[str], list[tuple[int, str]]]:
    """Header and comment lines, and the numbered lines of data. `_rows` raises the error for text between the data."""
    header: list[str] = []
    data: list[tuple[int, str]] = []
    for at, line in enumerate(lines, start=1):
        text = line.strip()
        if not text:
            continue
        if text.startswith(_COMMENT) or (not data and not _only_numbers(text)):
            header.append(text)
        else:
            data.append((at, text))
    if not data:
        fix = "give PEER AT2, COSMOS V2, or columns of numbers"
        raise FileError(Issue("file", "contains no numbers", lines[0].strip(), fix))
    return header, data


def _only_numbers(text: str) -> bool:
    fields = re.split(r"[\t;,\s]+", text)
    return all(value(field) is not None for field in fields if field)


def _rows(data: list[tuple[int, str]]) -> list[Row]:
    separator, decimal_comma = _separator(data)
    rows: list[Row] = []
    for at, text in data:
        if separator:
            fields = text.removesuffix(separator).split(separator)
            if not all(field.strip() for field in fields):
                raise FileError(Issue(f"line {at}", "has an empty field", text, "fill the field or remove the line"))
            text = " ".join(fields)
        rows.append((at, numbers(text.replace(",", ".") if decimal_comma else text, f"line {at}")))
    return rows


def _separator(data: list[tuple[int, str]]) -> tuple[str, bool]:
    """Separator (empty: spaces), and whether the comma is the decimal sign. Raises FileError where this is ambiguous."""
    text = "\n".join(line for _, line in data)
    separator = next((sign for sign in ";\t" if sign in text), "")
    if "," not in text:
        return separator, False
    if "." in text:
        if separator:
            at, line = next((at, line) for at, line in data if "," in line)
            raise FileError(Issue(f"line {at}", "has both comma and point", line, "write numbers with a decimal point only"))
        return ",", False
    fields = re.split(separator or r"\s+", text.replace("\n", separator or "\n"))
    if separator or any(len(line.split()) > 1 for _, line in data):
        with_comma = [field.strip() for field in fields if "," in field]
        if all(_DECIMAL_COMMA.fullmatch(field) for field in with_comma):
            return separator, True
    at, line = next((at, line) for at, line in data if "," in line)
    fix = "write numbers with a decimal point, or separate the columns by semicolons"
    raise FileError(Issue(f"line {at}", "the comma can be a decimal sign or a separator", line, fix))


def header_step(header: list[str]) -> float | None:
    """The time step (s) from a header that states a step or a sampling rate; None where it states neither."""
    for line in header:
        if found := _STEP.search(line):
            milli = "ms" in ((found[1] or "").lower(), (found[3] or "").lower())
            return float(found[2]) * (1e-3 if milli else 1.0)
        if (found := _RATE.search(line)) and float(found[1]) > 0:
            return 1 / float(found[1])
    return None


def _count_and_step(rows: list[Row]) -> float | None:
    """The step (s) where the first line is `count step` for the samples after it; else None."""
    first, rest = rows[0][1], sum(len(row) for _, row in rows[1:])
    return first[1] if len(first) == 2 and rest > 2 and first[0] == rest and 0 < first[1] < 1 else None


def _is_time(table: Array) -> bool:
    """Whether the first column can be time: it always increases. Two columns are always time and acceleration."""
    return len(table) > 2 and (table.shape[1] == 2 or bool(np.all(np.diff(table[:, 0]) > 0)))


def _uniform_step(times: Array, rows: Sequence[Row]) -> float:
    bad = np.flatnonzero(~np.isfinite(times))
    if len(bad):
        raise FileError(Issue(f"line {rows[bad[0]][0]}", "time needs a finite number", str(times[bad[0]])))
    dt = float(f"{np.median(np.diff(times)):.9g}")
    if len(times) > 1 and dt > 0:
        dt = float(f"{(times[-1] - times[0]) / round((times[-1] - times[0]) / dt):.9g}")
    off = np.flatnonzero(np.abs(times - times[0] - np.arange(len(times)) * dt) > _UNIFORM * abs(dt))
    if dt <= 0 or len(off):
        at = rows[off[0] if len(off) else 0][0]
        fix = "resample the record to a uniform step; for acceleration only, write one value on each line"
        problem = f"the first column is not a time with a uniform step (about {dt:g} s)"
        raise FileError(Issue(f"line {at}", problem, f"{times[off[0] if len(off) else 0]:g}", fix))
    return dt


FORMAT = Format(
    key="record",
    title="Plain text of one record",
    of="ground motion",
    extensions=("txt", "csv", "dat", "acc"),
    defined="acceleration alone, or time and acceleration",
    header="step or sampling rate, unit",
    compared="step of the time column",
    looks_like=looks_like,
    read=read,
)
