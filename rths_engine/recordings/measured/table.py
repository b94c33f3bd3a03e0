"""The table that a reader returns: named columns of numbers, with the units and the step that the file states."""

from __future__ import annotations

import difflib
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import Issue, MeasuredError

# chosen; see docs/decisions/0023
MOST_SAMPLES = 50_000_000  # in all columns: 400 MB
MOST_COLUMNS = 1000
LONGEST_NAME = 200


@dataclass(frozen=True, eq=False)
class Column:
    """A column of numbers. `unit` as the file writes it; `dt` (s) where the file states a step for the values."""

    name: str
    values: Array
    unit: str = ""
    dt: float | None = None


@dataclass(frozen=True, eq=False)
class Table:
    """The columns of a file. `named`: their names are from the file. `hints`: units for quantities that are not columns."""

    format: str
    columns: tuple[Column, ...]
    named: bool = True
    hints: dict[str, str] = field(default_factory=dict)
    notes: tuple[str, ...] = ()

    @cached_property
    def names(self) -> dict[str, Column]:
        return {column.name: column for column in self.columns}

    def column(self, name: str | int, where: str) -> Column:
        """A column by name or by number from 1. Raises MeasuredError with similar names where there is none."""
        if isinstance(name, int) and 1 <= name <= len(self.columns):
            return self.columns[name - 1]
        if (found := self.names.get(str(name))) is not None:
            return found
        near = difflib.get_close_matches(str(name), list(self.names), 3, 0.5)
        offered = ", ".join(near or list(self.names)[:12])
        raise MeasuredError(Issue(where, "the file does not have this column", name, f"it has {offered}"))


def checked(table: Table) -> Table:
    """The table with names that can be stored. Raises MeasuredError where it has no column, or more data than the limits."""
    if not table.columns:
        raise MeasuredError(
            Issue("file", "contains no column of numbers", table.format, "export the signals as arrays or columns")
        )
    if len(table.columns) > MOST_COLUMNS:
        problem = f"has {len(table.columns)} columns; the maximum is {MOST_COLUMNS}"
        raise MeasuredError(Issue("file", problem, fix="export fewer signals, one signal a column"))
    refuse_many(sum(len(column.values) for column in table.columns))
    return replace(
        table, columns=tuple(replace(one, name=_storable(one.name), unit=_storable(one.unit)) for one in table.columns)
    )


def _storable(text: str) -> str:
    """The text without characters that files and databases cannot store: NUL and halves of surrogate pairs."""
    return text.replace("\0", "").encode("utf-8", "replace").decode()[:LONGEST_NAME]


def refuse_many(samples: int) -> None:
    """Raises MeasuredError where a file has, or states that it has, more samples than the limit."""
    if samples > MOST_SAMPLES:
        problem = f"has {samples:,} samples; the maximum is {MOST_SAMPLES:,}"
        raise MeasuredError(Issue("file", problem, fix="export fewer signals, a shorter time or a lower rate"))


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
