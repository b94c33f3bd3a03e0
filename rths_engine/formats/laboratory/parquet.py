"""Parquet: the numeric columns, read by the Arrow implementation in Rust (arro3)."""

from __future__ import annotations

import io
from typing import Any

import numpy as np

from rths_engine.formats.format import Format
from rths_engine.formats.source import Source
from rths_engine.formats.table import Column, Table, refuse_many
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import FileError, Issue

# chosen; see docs/decisions/0023
BATCH = 65_536  # rows


def looks_like(source: Source) -> bool:
    """Whether the content is a Parquet file."""
    return source.head.startswith(b"PAR1") or source.tail.endswith(b"PAR1")


def read(source: Source) -> Table:
    """Read the file. Raises FileError for errors of any kind, which a damaged file can cause."""
    try:
        return _table(source.bytes())
    except (FileError, KeyboardInterrupt, SystemExit):
        raise
    except BaseException as error:  # a panic of the Rust reader is not an Exception
        problem = f"cannot be read as Parquet: {type(error).__name__}"
        raise FileError(Issue("file", problem, fix="write the file again, or export it as CSV")) from None


def _table(raw: bytes) -> Table:
    from arro3.core import DataType
    from arro3.io import read_parquet

    reader = read_parquet(io.BytesIO(raw), batch_size=BATCH)
    fields = [reader.schema.field(k) for k in range(len(reader.schema.names))]
    numeric = [k for k, field in enumerate(fields) if DataType.is_numeric(field.type) and not DataType.is_decimal(field.type)]
    parts: dict[int, list[Array]] = {k: [] for k in numeric}
    rows = 0
    for batch in reader:
        rows += batch.num_rows
        refuse_many(rows * max(1, len(numeric)))
        for k in numeric:
            parts[k].append(_numbers(batch.column(k)))
    columns = [Column(fields[k].name, np.concatenate(parts[k]), _unit(fields[k])) for k in numeric if rows > 1]
    left = tuple(f"column {field.name} contains no numbers" for k, field in enumerate(fields) if k not in numeric)
    return Table("Parquet", tuple(columns), notes=left)


def _numbers(values: Any) -> Array:
    """Float64 values, with NaN for missing values."""
    from arro3.core import DataType

    if values.null_count:
        return np.array([np.nan if (one := item.as_py()) is None else float(one) for item in values])
    return np.asarray(values.cast(DataType.float64()).to_numpy(), dtype=float)


def _unit(field: Any) -> str:
    metadata = {bytes(key): bytes(value) for key, value in dict(field.metadata).items()}
    return next((metadata[name].decode("utf-8", "replace") for name in (b"unit", b"units") if name in metadata), "")


FORMAT = Format(
    key="parquet",
    title="Parquet",
    of="measurement",
    extensions=("parquet",),
    defined="Apache Parquet",
    header="column names, units in their metadata",
    compared="",
    looks_like=looks_like,
    read=read,
    library="arro3",
    apart=True,
)
