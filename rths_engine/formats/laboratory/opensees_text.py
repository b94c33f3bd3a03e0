"""Text recorder of OpenSees and OpenFresco (.out): rows of numbers between blanks, without header, names and units."""

from __future__ import annotations

import re
from collections import Counter
from pathlib import PurePosixPath

import numpy as np

from rths_engine.formats import few_digits
from rths_engine.formats.format import Format
from rths_engine.formats.laboratory import rows
from rths_engine.formats.laboratory.opensees_xml import FIRST_ROW, UNITLESS
from rths_engine.formats.source import Source
from rths_engine.formats.table import Column, Table
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import FileError, Issue

# by definition
_ENVELOPE = 3  # rows: minimum, maximum, largest absolute value

# responses of OpenFresco's recorders in names of files: `Control_daqFrc.out`
_RESPONSE = re.compile(r"(trial|out|ctrl|daq)(Dis?p|Dsp|Vel|Acc(?:el)?|Force|Frc|Ti?me)", re.IGNORECASE)
_ORIGIN = {"trial": "wanted", "out": "returned", "ctrl": "command", "daq": "measured"}
_QUANTITY = {"d": "displacement", "v": "velocity", "a": "acceleration", "f": "force", "t": "time"}


def looks_like(source: Source) -> bool:
    """Whether the name ends with .out and the first lines contain only numbers between blanks."""
    first = [line for line in source.head_lines[:5] if line.strip()]
    numbers = [all(rows.number(one) is not None for one in line.split()) for line in first]
    return source.extension == "out" and bool(first) and any(numbers) and sum(numbers) >= len(first) - 1


def read(source: Source) -> Table:
    """The columns of the recorder. Raises FileError for a row of another width and for an envelope."""
    data = [(at, line.rstrip()) for at, line in enumerate(source.lines, start=1) if line.strip()]
    if not data:
        raise FileError(Issue("file", "has no line with numbers", fix="choose the file of a recorder"))
    width = Counter(len(line.split()) for _, line in data).most_common(1)[0][0]
    names = [f"column {k}" for k in range(1, width + 1)]
    values, _ = rows.values(data, "", ".", range(width), range(width, width + 1), names)
    if _is_envelope(values):
        problem = "holds the minimum, the maximum and the largest absolute value of each response, not a time history"
        raise FileError(Issue("file", problem, fix="record with a Node or Element recorder instead of an Envelope recorder"))
    response = _RESPONSE.search(PurePosixPath(source.name.replace("\\", "/")).stem)
    first = 1 if width > 1 and len(values) > 1 and _rises(values[:, 0]) else 0
    columns = [
        _column(names[k], np.ascontiguousarray(values[:, k]), response if k >= first else None, k - first + 1)
        for k in range(width)
    ]
    notes = [UNITLESS, "it does not state whether the first column is time, or the load factor of a static analysis", FIRST_ROW]
    if response is not None:
        notes.append(f"{response[0]} is from the name of the file, which the file does not confirm")
    return Table("OpenSees recorder (text)", tuple(columns), named=response is not None, notes=tuple(notes))


def _column(name: str, values: Array, response: re.Match[str] | None, number: int) -> Column:
    if response is None:
        return Column(name, values)
    quantity = _QUANTITY[response[2][0].lower()]
    return Column(f"{_ORIGIN[response[1].lower()]} {quantity} {number} ({response[0]})", values, quantity=quantity)


def _rises(values: Array) -> bool:
    """Whether values increase; times of six digits can be equal to each other."""
    return bool(np.all(np.diff(values) > 0)) or few_digits.equal_steps(values) is not None


def _is_envelope(values: Array) -> bool:
    """Whether three rows are minimum, maximum and largest absolute value, with or without a time before each response."""
    if len(values) != _ENVELOPE:
        return False
    low, high, largest = values
    fits = (low <= high) & (largest == np.maximum(np.abs(low), np.abs(high)))
    return bool(fits.all() or (len(fits) % 2 == 0 and fits[1::2].all()))


FORMAT = Format(
    key="opensees-text",
    title="OpenSees and OpenFresco recorder (text)",
    of="measurement",
    extensions=("out",),
    defined="OpenSees, Node and Element recorders; OpenFresco, experimental recorders",
    header="none; neither time, names nor units: they are asked for",
    compared="number of fields in every row; envelopes are refused",
    looks_like=looks_like,
    read=read,
    public=38,
    public_check="the rows of each file split by Python; ten more, whose rows are cut, are refused with the line",
)
