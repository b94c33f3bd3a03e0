"""The table that a reader returns: named columns of numbers, with the units and the step that the file states."""

from __future__ import annotations

import difflib
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from rths_engine.formats.scratch import on_disk
from rths_engine.formats.statement import Statement
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import FileError, Issue

# chosen; see docs/decisions/0023
MOST_SAMPLES = 50_000_000  # in all columns in memory: 400 MB; numeric_block.MOST_VALUES limits those in a scratch file
MOST_COLUMNS = 1000
LONGEST_NAME = 200


@dataclass(frozen=True, eq=False)
class Column:
    """A column of numbers.

    `unit` as the file writes it; `dt` (s) where the file states a step for the values, and `start` (s) the time of the first
    value. `quantity` is what the format itself says that the values are (`acceleration`); empty where it does not.
    `applied` says which scale, gain or offset of the file the values contain: `counts x 3920/6000000 gal`. `time` names the
    column with the time stamps of the values, where the file assigns such a column to them.
    """

    name: str
    values: Array
    unit: str = ""
    dt: float | None = None
    start: float = 0.0
    quantity: str = ""
    applied: str = ""
    time: str = ""


@dataclass(frozen=True, eq=False)
class Table:
    """The columns of a file.

    `named`: their names are from the file. `hints`: units for quantities that are not columns. `notes`: what was left out and
    why. `statements`: what the header states beside what was read. `header`: the text of the header as it stands in the file.
    `about`: title, event, station and the like.
    """

    format: str
    columns: tuple[Column, ...]
    named: bool = True
    hints: dict[str, str] = field(default_factory=dict)
    notes: tuple[str, ...] = ()
    statements: tuple[Statement, ...] = ()
    header: str = ""
    about: dict[str, str] = field(default_factory=dict)

    @cached_property
    def names(self) -> dict[str, Column]:
        return {column.name: column for column in self.columns}

    def column(self, name: str | int, where: str) -> Column:
        """A column by name or by number from 1. Raises FileError with similar names where there is none."""
        if isinstance(name, int) and 1 <= name <= len(self.columns):
            return self.columns[name - 1]
        if (found := self.names.get(str(name))) is not None:
            return found
        near = difflib.get_close_matches(str(name), list(self.names), 3, 0.5)
        offered = ", ".join(near or list(self.names)[:12])
        raise FileError(Issue(where, "the file does not have this column", name, f"it has {offered}"))


def checked(table: Table) -> Table:
    """The table with names that can be stored. Raises FileError where its header contradicts its data."""
    if not table.columns:
        raise FileError(Issue("file", "contains no column of numbers", table.format, "export the signals as arrays or columns"))
    if len(table.columns) > MOST_COLUMNS:
        problem = f"has {len(table.columns)} columns; the maximum is {MOST_COLUMNS}"
        raise FileError(Issue("file", problem, fix="export fewer signals, one signal a column"))
    refuse_many(sum(len(column.values) for column in table.columns if not on_disk(column.values)))
    if contradictions := list(dict.fromkeys(one.issue for one in table.statements if not one.agrees)):
        raise FileError(contradictions)
    return replace(
        table, columns=tuple(replace(one, name=_storable(one.name), unit=_storable(one.unit)) for one in table.columns)
    )


def _storable(text: str) -> str:
    """The text without characters that files and databases cannot store: NUL and halves of surrogate pairs."""
    return text.replace("\0", "").encode("utf-8", "replace").decode()[:LONGEST_NAME]


def refuse_many(samples: int) -> None:
    """Raises FileError where a file has, or states that it has, more samples than the limit."""
    if samples > MOST_SAMPLES:
        problem = f"has {samples:,} samples; the maximum is {MOST_SAMPLES:,}"
        raise FileError(Issue("file", problem, fix="export fewer signals, a shorter time or a lower rate"))


def spread(name: str, values: Array, names: Sequence[str] = (), unit: str = "", dt: float | None = None) -> list[Column]:
    """Columns of a 1-D or 2-D array, time along its longer side: `name`, or `name.1`, `name.2` ... unless `names` fit."""
    values = np.squeeze(np.asarray(values, dtype=float))
    if values.ndim == 1 and len(values) > 1:
        return [Column(name, values, unit, dt)]
    if values.ndim != 2:
        return []
    rows = values if values.shape[0] >= values.shape[1] else values.T
    count = rows.shape[1]
    own = list(names) if len(names) == count and len(set(names)) == count else [f"{name}.{k}" for k in range(1, count + 1)]
    return [Column(one, np.ascontiguousarray(rows[:, k]), unit, dt) for k, one in enumerate(own)]


def distinct(columns: Sequence[Column]) -> tuple[Column, ...]:
    """The columns; where several have one name, the number of the column is added to it."""
    times = Counter(column.name for column in columns)
    return tuple(
        column if times[column.name] == 1 else replace(column, name=f"{column.name} (column {k})")
        for k, column in enumerate(columns, start=1)
    )
