"""Parquet: time stamps become seconds, and what the metadata state is taken or compared."""

from __future__ import annotations

import io
import json
from typing import Any

import numpy as np
import pytest
from arro3.core import Array, DataType, Field, Schema, Table
from arro3.io import write_parquet

from rths_engine.formats import registry, table
from rths_engine.formats.source import Source
from rths_engine.foundation.errors import FileError

X = [0.0, 1.5, -3.0, 2.25]


def read(columns: dict[str, Array], metadata: dict[str, str] | None = None) -> table.Table:
    fields = [Field(name, one.type, nullable=True) for name, one in columns.items()]
    raw = io.BytesIO()
    write_parquet(Table.from_arrays(list(columns.values()), schema=Schema(fields, metadata=metadata or {})), raw)
    return registry.read(Source("a.parquet", content=raw.getvalue()))


def numbers(values: list[float]) -> Array:
    return Array(values, type=DataType.float64())


def ticks(kind: DataType, values: list[int | None], whole: DataType | None = None) -> Array:
    return Array(values, type=whole or DataType.int64()).cast(kind)


@pytest.mark.parametrize(("unit", "per_second"), [("s", 1), ("ms", 1000), ("us", 10**6), ("ns", 10**9)])
@pytest.mark.parametrize("zone", [None, "UTC"])
def test_time_stamps_are_seconds_from_the_first(unit: Any, per_second: int, zone: str | None) -> None:
    step = 1 if unit == "s" else per_second // 250
    stamps = ticks(DataType.timestamp(unit, tz=zone), [1_714_979_289 * per_second + step * k for k in range(4)])
    time, force = read({"timestamp": stamps, "force_kN": numbers(X)}).columns
    np.testing.assert_allclose(time.values, step / per_second * np.arange(4), rtol=1e-15)
    assert (time.unit, time.quantity, force.values.tolist()) == ("s", "time", X)


def test_durations_dates_times_of_day_and_missing_stamps() -> None:
    duration = ticks(DataType.duration("us"), [4000 * k for k in range(4)])
    days = ticks(DataType.date32(), [19_000 + k for k in range(4)], DataType.int32())
    clock = ticks(DataType.time32("ms"), [7_000_000 + 4 * k for k in range(4)], DataType.int32())
    gap = ticks(DataType.timestamp("ms"), [1000, None, 3000, 4000])
    found = read({"t": duration, "day": days, "clock": clock, "gap": gap, "f": numbers(X)}).columns
    np.testing.assert_allclose(found[0].values, 0.004 * np.arange(4), atol=1e-12)
    assert found[1].values.tolist() == [0.0, 86400.0, 172800.0, 259200.0]
    np.testing.assert_allclose(found[2].values, 0.004 * np.arange(4), atol=1e-12)
    np.testing.assert_array_equal(found[3].values, [0.0, np.nan, 2.0, 3.0])


@pytest.mark.parametrize(
    ("metadata", "dt"),
    [
        ({"sampling_rate_hz": "250"}, 0.004),
        ({"dt": "4 ms"}, 0.004),
        ({"dt": "4", "dt_unit": "ms"}, 0.004),
        ({"sampling_period": "4"}, None),
        ({}, None),
    ],
)
def test_the_metadata_of_the_file_state_step_and_units(metadata: dict[str, str], dt: float | None) -> None:
    units = json.dumps({"force": "kN", "disp": "mm"})
    found = read({"force": numbers(X), "disp": numbers(X)}, {**metadata, "units": units})
    assert [(one.unit, one.dt) for one in found.columns] == [("kN", dt), ("mm", dt)]
    assert bool(found.notes) == ("sampling_period" in metadata)


@pytest.mark.parametrize(
    ("metadata", "told"),
    [
        ({"rate": "500"}, "rate: states a time step of time_s of 0.002 s; the data have 0.004 s"),
        ({"rate": "250", "n_samples": "401"}, "n_samples: states a number of samples of 401; the data have 4"),
    ],
)
def test_metadata_that_contradict_the_data_refuse_the_file(metadata: dict[str, str], told: str) -> None:
    with pytest.raises(FileError) as refusal:
        read({"time_s": numbers([0.0, 0.004, 0.008, 0.012]), "force": numbers(X)}, metadata)
    assert told in str(refusal.value)
