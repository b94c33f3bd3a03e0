"""TracerDAQ text (Measurement Computing): lines `key: value`, then sample number, date and time, channels, events."""

from __future__ import annotations

import re
from collections.abc import Sequence

import numpy as np

from rths_engine.formats import dates
from rths_engine.formats.format import Format
from rths_engine.formats.laboratory import rows
from rths_engine.formats.laboratory.rows import Line
from rths_engine.formats.source import Source
from rths_engine.formats.statement import COARSE, Statement, Written, count
from rths_engine.formats.table import Column, Table, distinct
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import FileError, Issue

# chosen; see docs/decisions/0023
_LONGEST_HEADER = 60  # lines
_ROUNDED = 1e-3  # of the step: interval and rate are rounded apart
_GAP = 1.5  # steps between two rows, from which samples are missing

_SCALES = {"ms": 1e-3, "khz": 1e3}  # to s and Hz, by definition
_FIRST, _STAMP, _EVENTS = "sample number", "date/time", "events"


def looks_like(source: Source) -> bool:
    """Whether a heading begins with a sample number and a date, after lines `key: value`."""
    return _heading(source.head_lines) is not None


def read(source: Source) -> Table:
    """The channels of the file. Raises FileError with the line where rows do not follow the heading."""
    lines = source.lines
    at = _heading(lines)
    if at is None:
        fix = "the rows follow a line that begins with Sample Number, Date/Time"
        raise FileError(Issue("file", "has no line that names the columns", fix=fix))
    separator = next((sign for sign in ("\t", ";") if sign in lines[at - 1]), ",")
    names = [one.strip('"') for one in rows.fields(lines[at - 1], separator)]
    stated = _stated(lines[: at - 1])
    data = [(k, line.rstrip()) for k, line in enumerate(lines[at:], start=at + 1) if line.strip()]
    last = len(names) - 1 if names[-1].lower() == _EVENTS else len(names)
    dated = len(names) > 1 and names[1].lower() == _STAMP
    used = [0, *range(2 if dated else 1, last)]
    decimal = rows.decimal_sign(data, separator)
    numbers, empty = rows.values(data, separator, decimal, used, range(last, len(names) + 1), [names[k] for k in used])
    if not len(numbers):
        raise FileError(Issue("file", "contains no rows", fix="get the file again"))
    if empty.any():
        row, column = (int(one) for one in np.argwhere(empty)[0])
        raise FileError(Issue(f"line {data[row][0]}", f"column {names[used[column]]} is empty", fix="correct the line"))
    _consecutive(numbers[:, 0], data)
    statements = []
    if "header size" in stated:
        statements.append(
            Statement("number of lines before the data", stated["header size"].where, stated["header size"].value, at)
        )
    if (samples := stated.get("sample count") or stated.get("samples")) is not None:
        statements.append(count(int(samples.value), len(numbers), samples.where))
    dt, found, more = _step(stated, [rows.fields(text, separator)[1] for _, text in data] if dated else [], data)
    columns = [Column(names[k], np.ascontiguousarray(numbers[:, j]), "", dt) for j, k in enumerate(used) if k]
    events = [(line, given[last]) for line, text in data if len(given := rows.fields(text, separator)) > last and given[last]]
    if (counted := next((line for line, text in events if rows.number(text) is not None), 0)) != 0:
        problem = "has one number more than the heading has channels"
        raise FileError(Issue(f"line {counted}", problem, fix="correct the line; the decimal sign is a point"))
    notes = [f"line {events[0][0]}: {len(events)} events are not read"] if events else []
    return Table(
        "TracerDAQ text",
        distinct(columns),
        notes=(*notes, *more),
        statements=(*statements, *found),
        header="\n".join(lines[:at]),
        about={"start": rows.fields(data[0][1], separator)[1]} if dated else {},
    )


def _heading(lines: Sequence[str]) -> int | None:
    """Number of the line that names the columns."""
    for at, line in enumerate(lines[:_LONGEST_HEADER], start=1):
        if line.strip().strip('"').lower().startswith(_FIRST) and not re.match(r'"?sample number\s*:', line.strip().lower()):
            return at
    return None


def _stated(header: Sequence[str]) -> dict[str, Written]:
    """The numbers of the header by their words in lower case."""
    found = {}
    for at, line in enumerate(header, start=1):
        match = re.match(r'\s*"?([A-Za-z /]+?)\s*:"?[\s,;]*"?([-+.\deE]+)\s*(ms|kHz)?"?', line, re.IGNORECASE)
        if match:
            try:
                one, scale = Written.of(match[2], f"line {at}"), _SCALES.get((match[3] or "").lower(), 1.0)
                found[match[1].lower()] = Written(one.value * scale, one.within * scale, one.where)
            except ValueError:
                continue
    return found


def _consecutive(numbers: Array, data: Sequence[Line]) -> None:
    off = np.flatnonzero(np.diff(numbers) != 1)
    if len(off):
        k = int(off[0]) + 1
        problem = f"has the sample number {numbers[k]:g} after {numbers[k - 1]:g}: samples are missing, or a new record starts"
        raise FileError(Issue(f"line {data[k][0]}", problem, fix="export each record to a file of its own"))


def _step(
    stated: dict[str, Written], texts: list[str], data: Sequence[Line]
) -> tuple[float | None, list[Statement], list[str]]:
    """Step (s): as stated, else of the stamps; both beside each other; and a note where the stamps go back."""
    interval, rate = stated.get("sampling interval"), stated.get("sampling rate")
    dt = interval.value if interval is not None else 1 / rate.value if rate is not None and rate.value > 0 else None
    found = []
    if interval is not None and rate is not None and rate.value > 0:
        within = interval.within + rate.within / rate.value**2 + _ROUNDED * interval.value
        found.append(Statement("sampling interval", interval.where, interval.value, 1 / rate.value, "s", within))
    if len(texts) < 2:
        return dt, found, []
    stamps = dates.seconds([text.strip('"') for text in texts], [at for at, _ in data])
    between, digit = np.diff(stamps.seconds), stamps.resolution
    shown = float(np.median(between))
    step = dt if dt is not None else float(np.mean(between))
    forward = between[between >= 0]
    if dt is not None:
        one = interval or rate
        assert one is not None
        stretches = 1 + len(between) - len(forward)  # each begins and ends with a rounded stamp
        shown = float(np.mean(forward)) if len(forward) else shown
        rounded = min(interval.within if interval is not None else 0.0, COARSE * shown)
        within = rounded + 2 * digit * stretches / max(1, len(forward)) + _ROUNDED * dt
        found.append(Statement("sampling interval by the dates of the rows", one.where, dt, shown, "s", within))
    if len(late := np.flatnonzero(between > _GAP * step + 2 * digit)):
        k = int(late[0])
        problem = f"is {between[k]:.6g} s after the row before; the step is {step:g} s"
        raise FileError(Issue(f"line {data[k + 1][0]}", problem, fix="samples are missing: export the parts one by one"))
    if len(back := np.flatnonzero(between < 0)):
        k = int(back[0])
        note = f"line {data[k + 1][0]}: the time of day goes back by {-between[k]:.6g} s; the stated interval is used"
        return dt, found, [note if dt is not None else note.partition(";")[0] + ": give the rate"]
    return (step if step > 0 else None), found, []


FORMAT = Format(
    key="tracerdaq",
    title="TracerDAQ text",
    of="measurement",
    extensions=("txt", "csv"),
    defined="TracerDAQ, Measurement Computing; no public definition, the words of its files",
    header="number of header lines, sampling interval or rate (s, Hz), number of samples, names; no units: they are asked for",
    compared="header lines, samples, sample numbers, interval with the dates of the rows",
    looks_like=looks_like,
    read=read,
    public_check="no public file could be had",
)
