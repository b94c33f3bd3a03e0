"""Campbell Scientific TOA5: four quoted lines (station, names, units, processing), then rows of date, record and values."""

from __future__ import annotations

import csv
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from rths_engine.formats import dates
from rths_engine.formats.format import Format
from rths_engine.formats.source import Source
from rths_engine.formats.table import Column, Table, distinct
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import FileError, Issue

# by definition: LoggerNet manual, appendix "Campbell Scientific File Formats", Campbell Scientific
_HEADER_LINES = 4
_OUT_OF_RANGE = {7999.0, -7999.0}
_TIMES = {"tmx", "tmn"}  # the time of a largest or a smallest value
_STATION = ("format", "station", "logger", "serial number", "operating system", "program", "signature", "table")
_MISSING = {"", "nan", "inf", "-inf", "+inf"}


def looks_like(source: Source) -> bool:
    """Whether the first field is TOA5."""
    return source.head.lstrip(b"\xef\xbb\xbf").startswith((b'"TOA5"', b"TOA5,"))


def read(source: Source) -> Table:
    """The numeric columns, time in s after the first row. Raises FileError with the line whose number of fields differs."""
    lines = [(at, line) for at, line in enumerate(source.lines, start=1) if line.strip()]
    given = [(at, next(csv.reader([line]))) for at, line in lines]
    if len(given) <= _HEADER_LINES:
        problem = f"has {len(given)} lines: the header has {_HEADER_LINES}, rows follow"
        raise FileError(Issue("file", problem, fix="get the file again"))
    width = len(given[1][1])
    for at, fields in given[1:]:
        if len(fields) != width:
            problem = f"has {len(fields)} fields; line {given[1][0]} names {width}"
            raise FileError(Issue(f"line {at}", problem, ",".join(fields), "get the file again, or correct the line"))
    (_, station), (_, names), (_, units), (_, processing) = given[:_HEADER_LINES]
    data = given[_HEADER_LINES:]
    columns: list[Column] = []
    notes: list[str] = []
    for k, (name, unit, process) in enumerate(zip(names, units, processing, strict=True)):
        texts = [fields[k].strip() for _, fields in data]
        if name.upper() == "TIMESTAMP":
            stamps = dates.seconds(texts, [at for at, _ in data])
            columns.append(Column(name, stamps.seconds, "s", quantity="time"))
        elif name.upper() == "RECORD":
            notes += _records(name, texts, data)
        elif unit == "TS" or process.lower() in _TIMES:
            notes.append(f"{name} holds times; it is not read")
        else:
            columns.append(Column(name, _numbers(name, texts, data, notes), unit.strip()))
    if (time := next((one.name for one in columns if one.quantity == "time"), "")) != "":
        columns = [one if one.quantity else replace(one, time=time) for one in columns]
    about = dict(zip(_STATION, station, strict=False))
    header = "\n".join(line for _, line in lines[:_HEADER_LINES])
    return Table("Campbell TOA5", distinct(columns), notes=tuple(notes), header=header, about=about)


def _numbers(name: str, texts: Sequence[str], data: Sequence[tuple[int, list[str]]], notes: list[str]) -> Array:
    """The numbers of a column; NaN where the logger wrote that a value is out of range."""
    result = np.full(len(texts), np.nan)
    missing = []
    for k, text in enumerate(texts):
        try:
            value = float("nan") if text.lower() in _MISSING else float(text) if "_" not in text else None
        except ValueError:
            value = None
        if value is None:
            raise FileError(Issue(f"line {data[k][0]}", f"column {name} is not a number", text, "correct the line"))
        if np.isnan(value) or value in _OUT_OF_RANGE:
            missing.append(k)
        else:
            result[k] = value
    if missing:
        notes.append(f"{name} is out of range in {len(missing)} rows, first in line {data[missing[0]][0]}: missing values")
    return result


def _records(name: str, texts: Sequence[str], data: Sequence[tuple[int, list[str]]]) -> list[str]:
    """A note on record numbers that do not rise by one."""
    try:
        numbers = np.array([int(text) for text in texts])
    except ValueError:
        return [f"{name} holds text; it is not read"]
    off = np.flatnonzero(np.diff(numbers) != 1)
    if not len(off):
        return []
    k = int(off[0]) + 1
    where = f"line {data[k][0]}: {name} goes from {numbers[k - 1]} to {numbers[k]}"
    return [f"{where} ({len(off)} such steps): records are missing, or the logger was started again"]


FORMAT = Format(
    key="toa5",
    title="Campbell Scientific TOA5",
    of="measurement",
    extensions=("dat", "csv"),
    defined='LoggerNet manual, appendix "Campbell Scientific File Formats"',
    header="station, logger, program, names and units",
    compared="number of fields of every line, record numbers",
    looks_like=looks_like,
    read=read,
    public=5,
    public_check="the csv module and datetime of Python; ten damaged files of a parser's tests are refused",
)
