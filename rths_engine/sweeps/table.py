"""Results of a sweep as a table: columns in the units shown; as JSON, CSV, Arrow and Parquet."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import IO, Any

import numpy as np

from rths_engine.foundation import units
from rths_engine.foundation.arrays import Array
from rths_engine.sweeps.columns import Column

POINT, REASON = "point", "reason"
SUFFIXES = (".csv", ".parquet", ".arrow")


@dataclass(frozen=True)
class Table:
    """Rows of points: `points` (n) count from 0, `values` (n, columns) as stored, `reasons` by point."""

    columns: Sequence[Column]
    points: Array
    values: Array
    reasons: Mapping[int, str]

    def shown(self, place: int) -> Array:
        """One column (n) in its shown unit; NaN where there is no value."""
        column, values = self.columns[place], self.values[:, place]
        if not column.si:
            return values
        return (values - units.zero(column.shown)) / units.factor(column.shown)

    def texts(self, place: int) -> list[str | None]:
        """One column of categories as text."""
        names = self.columns[place].categories
        return [None if np.isnan(value) else names[int(value)] for value in self.values[:, place]]

    def listed(self, place: int) -> list[Any]:
        """One column as JSON values: text of a category, and null where there is no value."""
        if self.columns[place].categories:
            return self.texts(place)
        values = self.shown(place)
        found = values.astype(object)
        found[~np.isfinite(values)] = None
        return list(found)

    def as_dict(self) -> dict[str, list[Any]]:
        """Every column by its key, with the number of the point (from 1) first and the reason last."""
        numbers = [int(point) + 1 for point in self.points]
        own = {column.key: self.listed(place) for place, column in enumerate(self.columns)}
        return {POINT: numbers, **own, REASON: [self.reasons.get(int(point)) for point in self.points]}

    def ordered(self, key: str, descending: bool) -> Table:
        """The rows in the order of a column; rows without a value last. Rows of equal value keep their order."""
        values = self.points if key == POINT else self.values[:, [column.key for column in self.columns].index(key)]
        order = np.argsort(-values if descending else values, kind="stable")
        return self.taken(order)

    def taken(self, rows: Any) -> Table:
        """Some rows."""
        return Table(self.columns, self.points[rows], self.values[rows], self.reasons)


def decoded(columns: Sequence[Column], parts: Sequence[tuple[int, int, bytes, Mapping[str, str]]]) -> Table:
    """The table of stored parts, each with its first point, number of points, values and reasons."""
    points = [np.arange(first, first + count) for first, count, _, _ in parts]
    values = [np.frombuffer(data, "<f8").reshape(count, len(columns)) for _, count, data, _ in parts]
    reasons = {first + int(place): reason for first, _, _, own in parts for place, reason in own.items()}
    empty = np.zeros((0, len(columns)))
    return Table(columns, np.concatenate([np.zeros(0, int), *points]), np.concatenate([empty, *values]), reasons)


def heading(column: Column) -> str:
    """The heading of a column in a file: its key, with the unit where the key does not end with it."""
    unit = column.shown
    return f"{column.key} ({unit})" if column.role == "input" and unit != "1" else column.key


def csv_text(table: Table) -> str:
    """The table as CSV: numbers with nine digits, empty where there is no value."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\r\n")
    writer.writerow([POINT, *(heading(column) for column in table.columns), REASON])
    listed = table.as_dict().values()
    writer.writerows([_cell(value) for value in row] for row in zip(*listed, strict=True))
    return text.getvalue()


def arrow(table: Table) -> Any:
    """The table of arro3; each field carries label, unit and role, and the schema all of them as JSON."""
    from arro3.core import Array as ArrowArray
    from arro3.core import DataType, Field, Schema
    from arro3.core import Table as ArrowTable

    arrays = [ArrowArray.from_numpy(table.points.astype(np.int64) + 1)]
    fields = [Field(POINT, DataType.int64())]
    for place, column in enumerate(table.columns):
        about = {"label": column.label, "unit": column.shown, "role": column.role}
        if column.categories:
            arrays.append(ArrowArray(table.texts(place), DataType.utf8()))
            fields.append(Field(column.key, DataType.utf8(), metadata=about))
        else:
            arrays.append(ArrowArray.from_numpy(np.ascontiguousarray(table.shown(place), dtype=float)))
            fields.append(Field(column.key, DataType.float64(), metadata=about))
    arrays.append(ArrowArray([table.reasons.get(int(point)) for point in table.points], DataType.utf8()))
    fields.append(Field(REASON, DataType.utf8()))
    metadata = {"columns": json.dumps([column.as_dict() for column in table.columns])}
    return ArrowTable.from_arrays(arrays, schema=Schema(fields, metadata=metadata))


def arrow_bytes(table: Table) -> bytes:
    """The table as an Arrow stream."""
    from arro3.io import write_ipc_stream

    out = io.BytesIO()
    write_ipc_stream(arrow(table), out)
    return out.getvalue()


def write(table: Table, path: Path, out: IO[bytes]) -> None:
    """Write the table to `out` in the format of the suffix of `path`: one of SUFFIXES."""
    from arro3.io import write_ipc, write_parquet

    if path.suffix == ".csv":
        out.write(csv_text(table).encode())
    elif path.suffix == ".arrow":
        write_ipc(arrow(table), out)
    else:
        write_parquet(arrow(table), out)


def _cell(value: Any) -> Any:
    if value is None:
        return ""
    return f"{value:.9g}" if isinstance(value, float) else value
