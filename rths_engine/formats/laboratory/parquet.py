"""Parquet: the numeric columns, read by the Arrow implementation in Rust (arro3)."""

from __future__ import annotations

import io
import json
from typing import Any

import numpy as np

from rths_engine.formats import tree
from rths_engine.formats.attributes import Attributes
from rths_engine.formats.format import Format
from rths_engine.formats.source import Source
from rths_engine.formats.table import Column, Table, refuse_many
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import FileError, Issue

_TICKS = {"s": 1.0, "ms": 1e-3, "us": 1e-6, "ns": 1e-9}  # by definition of Arrow
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
    timed = {k for k, field in enumerate(fields) if DataType.is_temporal(field.type) and not DataType.is_interval(field.type)}
    numeric = [
        k
        for k, field in enumerate(fields)
        if k in timed or (DataType.is_numeric(field.type) and not DataType.is_decimal(field.type))
    ]
    parts: dict[int, list[Array]] = {k: [] for k in numeric}
    firsts: dict[int, int] = {}
    rows = 0
    for batch in reader:
        rows += batch.num_rows
        refuse_many(rows * max(1, len(numeric)))
        for k in numeric:
            column = batch.column(k)
            parts[k].append(_seconds(column, k, fields[k].type, firsts) if k in timed else _numbers(column))
    about = Attributes.of(metadata := _texts(reader.schema.metadata))
    notes = [f"column {field.name} contains no numbers" for k, field in enumerate(fields) if k not in numeric]
    notes += [f"metadata: {doubt}" for doubt in about.doubts]
    if about.scaling:
        notes.append(f"metadata: {', '.join(about.scaling)} not applied: it is not stated to which column it belongs")
    if rows < 2:
        return Table("Parquet", (), notes=tuple(notes))
    units = _units(metadata)
    columns = [
        Column(fields[k].name, np.concatenate(parts[k]), "s", about.step, quantity="time")
        if k in timed
        else Column(fields[k].name, np.concatenate(parts[k]), _unit(fields[k]) or units.get(fields[k].name, ""), about.step)
        for k in numeric
    ]
    statements = about.statements("", [rows], about.step) + tree.step_statements(columns, [about.step_name] * len(columns))
    return Table("Parquet", tuple(columns), notes=tuple(notes), statements=tuple(statements))


def _numbers(values: Any) -> Array:
    """Float64 values, with NaN for missing values."""
    from arro3.core import DataType

    if values.null_count:
        return np.array([np.nan if (one := item.as_py()) is None else float(one) for item in values])
    return np.asarray(values.cast(DataType.float64()).to_numpy(), dtype=float)


def _seconds(values: Any, k: int, kind: Any, firsts: dict[int, int]) -> Array:
    """Seconds from the first stamp of column `k`, which is kept in `firsts`; whole ticks are subtracted, so none is rounded."""
    from arro3.core import DataType

    days = DataType.is_date32(kind)
    if days or DataType.is_time32(kind):
        values = values.cast(DataType.int32())
    whole = values.cast(DataType.int64())
    ticks = np.array(
        [0 if (one := item.as_py()) is None else int(one) for item in whole] if whole.null_count else whole.to_numpy()
    )
    missing = np.array([item.as_py() is None for item in whole]) if whole.null_count else np.zeros(len(ticks), bool)
    if k not in firsts and not missing.all():
        firsts[k] = int(ticks[~missing][0])
    tick = 86400.0 if days else 1e-3 if DataType.is_date64(kind) else _TICKS[kind.time_unit]
    return np.where(missing, np.nan, (ticks - firsts.get(k, 0)) * tick)


def _unit(field: Any) -> str:
    metadata = _texts(field.metadata)
    return next((metadata[name] for name in ("unit", "units") if name in metadata), "")


def _units(metadata: dict[str, str]) -> dict[str, str]:
    """Units by the names of columns, from an object of JSON in the metadata."""
    for name in ("units", "unit"):
        try:
            found = json.loads(metadata.get(name, ""))
        except ValueError:
            continue
        if isinstance(found, dict):
            return {str(key): text for key, text in found.items() if isinstance(text, str)}
    return {}


def _texts(metadata: Any) -> dict[str, str]:
    return {
        bytes(key).decode("utf-8", "replace"): bytes(value).decode("utf-8", "replace") for key, value in dict(metadata).items()
    }


FORMAT = Format(
    key="parquet",
    title="Parquet",
    of="measurement",
    extensions=("parquet",),
    defined="Apache Parquet",
    header="column names, units in their metadata; units and step or rate in the metadata of the file",
    compared="time step, number of samples, where the metadata state them",
    looks_like=looks_like,
    read=read,
    library="arro3",
    apart=True,
)
