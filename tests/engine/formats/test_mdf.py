"""MDF files come back as an independent writer wrote them, each channel on the time stamps of its own group."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rths_engine.formats import apart
from rths_engine.formats.laboratory import mdf as reader
from rths_engine.formats.source import Source
from rths_engine.formats.table import Table
from rths_engine.foundation.errors import FileError
from rths_engine.recordings.measured import guess, imported
from rths_engine.recordings.measured.mapping import Mapping
from tests.engine.formats import binaries
from tests.engine.formats.writers import mdf4
from tests.engine.formats.writers.mdf4 import Channel, Group

pytest.importorskip("asammdf")
FAST, SLOW = np.arange(2000) / 100, 10 + np.arange(1280) / 256
X, F = 12.5 * np.sin(FAST), 5 + np.sin(SLOW)


def read(raw: bytes) -> Table:
    return binaries.read(raw, "a.mf4", "mdf")


def test_a_group_that_began_later_begins_later() -> None:
    table = read(mdf4.file(Group(FAST, [Channel("stroke", X, "mm")]), Group(SLOW, [Channel("force", F, "kN")], "late")))
    stroke, force = table.columns
    np.testing.assert_array_equal(force.values, F)
    assert stroke.dt == pytest.approx(0.01) and (stroke.start, stroke.unit) == (0.0, "mm")
    assert force.dt == pytest.approx(1 / 256) and (force.start, force.unit) == (10.0, "kN")


def test_uneven_stamps_are_a_column_and_hold_for_their_group_only() -> None:
    uneven = np.cumsum(0.005 + 0.001 * np.sin(np.arange(2000)))
    raw = mdf4.file(
        Group(uneven, [Channel("stroke mm", X, "mm")], "first"), Group(FAST, [Channel("force kN", X, "kN")], "second")
    )
    table = read(raw)
    assert [(one.name, one.time, one.dt) for one in table.columns] == [
        ("time (first)", "", None),
        ("stroke mm", "time (first)", None),
        ("force kN", "", pytest.approx(0.01)),
    ]
    found = imported(table, guess(table).mapping)
    assert found.dt == pytest.approx(0.005, rel=0.01)
    force = Mapping.model_validate(
        {
            "channels": [
                {"column": "time (first)", "role": "t", "unit": "s"},
                {"column": "force kN", "role": "f_meas", "unit": "kN"},
            ]
        }
    )
    assert imported(table, force).dt == pytest.approx(0.01)  # its own step, although the other group has as many stamps


def test_conversion_and_samples_that_are_not_valid() -> None:
    raw = np.arange(-50, 50, dtype="<i2")
    channels = [Channel("a", raw, "kN", factor=0.25, offset=2.0), Channel("b", raw.astype("<f8"), "mm", invalid=[7, 9])]
    a, b = read(mdf4.file(Group(FAST[:100], channels))).columns
    np.testing.assert_array_equal(a.values, 0.25 * raw + 2.0)
    assert a.applied == "raw x 0.25 + 2"
    assert len(b.values) == 100 and np.flatnonzero(np.isnan(b.values)).tolist() == [7, 9]


def test_version_3_as_asammdf_writes_it(tmp_path: Path) -> None:
    asammdf = pytest.importorskip("asammdf")
    with asammdf.MDF(version="3.30") as file:
        file.append([asammdf.Signal(X, FAST, name="stroke", unit="mm")])
        file.append([asammdf.Signal(F, SLOW, name="force", unit="kN")])
        file.save(tmp_path / "a.mdf")
    stroke, force = read((tmp_path / "a.mdf").read_bytes()).columns
    np.testing.assert_array_equal(force.values, F)
    assert (force.unit, force.start, stroke.unit, stroke.applied) == ("kN", 10.0, "mm", "")


@pytest.mark.parametrize(("unit", "factor"), [("s", 1.0), ("ms", 1e-3), ("ns", 1e-9)])
def test_time_stamps_in_another_unit_become_seconds(unit: str, factor: float) -> None:
    column = read(mdf4.file(Group(FAST / factor, [Channel("a", X)], time_unit=unit))).columns[0]
    assert column.dt == pytest.approx(0.01)


def test_contradictions_are_refused_with_both_numbers() -> None:
    raw = np.arange(100, dtype="<i2")
    with pytest.raises(FileError, match="channel a: states a largest raw value of 50; the data have 99"):
        read(mdf4.file(Group(FAST[:100], [Channel("a", raw, range=(0, 50))])))
    with pytest.raises(FileError, match="150"):
        read(mdf4.file(Group(FAST[:100], [Channel("a", raw)], stated=150)))
    with pytest.raises(FileError, match="is an MDF file that was not closed"):
        reader.read(Source("a.mf4", content=b"UnFinMF 4.10    "))


@settings(max_examples=20)
@given(
    st.lists(st.lists(st.floats(-1e9, 1e9), min_size=2, max_size=40), min_size=1, max_size=3),
    st.floats(1e-4, 1.0),
    st.floats(0, 100),
)
def test_any_written_file_gives_its_values_back(records: list[list[float]], dt: float, start: float) -> None:
    groups = [
        Group(start + np.arange(len(v)) * dt, [Channel(f"c{k}", np.array(v), "kN")], f"g{k}") for k, v in enumerate(records)
    ]
    for column, values in zip(read(mdf4.file(*groups)).columns, records, strict=True):
        np.testing.assert_array_equal(column.values, values)
        assert (column.unit, column.start) == ("kN", start) and column.dt == pytest.approx(dt, rel=1e-6)


RAW = mdf4.file(
    Group(FAST[:40], [Channel("a", X[:40], "kN", invalid=[2]), Channel("b", np.arange(40, dtype="<i2"), factor=0.5)])
)


def apart_read(source: Source) -> Table:
    return apart.read(source, "mdf")  # in its process: after a damaged file, asammdf complains while it is collected


@settings(max_examples=60)
@given(st.lists(st.tuples(st.integers(0, 10**9), st.integers(0, 255)), max_size=4), st.integers(0, 10**9))
def test_a_damaged_file_is_read_or_refused(changes: list[tuple[int, int]], cut: int) -> None:
    binaries.read_or_refused(apart_read, binaries.damaged(RAW, changes, cut), "a.mf4")


def test_no_cut_of_a_file_is_read_with_other_values() -> None:
    whole = read(RAW)
    for cut in range(65, len(RAW), 13):
        found = binaries.read_or_refused(apart_read, RAW[:cut], "a.mf4")
        for column in found.columns if found else ():
            np.testing.assert_array_equal(column.values, whole.names[column.name].values)
