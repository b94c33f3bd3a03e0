"""FAMOS files come back as an independent writer wrote them: scales, units, starts, triggers, XY data, interleaved samples."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rths_engine.formats.laboratory import famos as reader
from rths_engine.formats.table import Table
from rths_engine.foundation.errors import FileError
from tests.engine.formats import binaries
from tests.engine.formats.writers import famos
from tests.engine.formats.writers.famos import Channel

X = 12.5 * np.sin(np.arange(400) / 9)
VALUES = st.lists(st.floats(-1e9, 1e9), min_size=2, max_size=50)


def read(raw: bytes) -> Table:
    return binaries.read(raw, "a.raw", "famos")


def test_channels_keep_their_scale_unit_step_and_trigger() -> None:
    raw = (100 * X).astype("<i2")
    one = Channel("Kraft", X, 0.005, 416.0, "kN")
    other = Channel("Weg", raw, 10.0, unit="mm", factor=0.01, offset=-3.0, second=2.5, axis_unit="ms")
    force, stroke = read(famos.file(one, other)).columns
    np.testing.assert_array_equal(force.values, X)
    assert (force.name, force.unit, force.dt, force.start) == ("Kraft", "kN", 0.005, 416.0)
    np.testing.assert_allclose(stroke.values, 0.01 * raw - 3.0, rtol=1e-14)
    assert (stroke.unit, stroke.dt, stroke.start, stroke.applied) == ("mm", 0.01, 2.5, "raw x 0.01 + -3")


@pytest.mark.parametrize("kind", ["u1", "i1", "<u2", "<i2", "<u4", "<i4", "<f4", "<f8"])
def test_every_numeric_type(kind: str) -> None:
    values = np.arange(100).astype(kind)
    np.testing.assert_array_equal(read(famos.file(Channel("a", values))).columns[0].values, np.arange(100))


def test_interleaved_samples_and_pairs_of_time_and_value() -> None:
    a, b = read(famos.file(Channel("a", X), Channel("b", (X * 10).astype("<i2")), interleaved=True)).columns
    np.testing.assert_array_equal(a.values, X)
    np.testing.assert_array_equal(b.values, (X * 10).astype("<i2"))
    uneven = np.cumsum(0.1 + 0.05 * np.sin(np.arange(400)))
    stamps, c = read(famos.file(Channel("c", X, times=uneven))).columns
    np.testing.assert_array_equal(stamps.values, uneven)
    assert c.time == stamps.name == "time of c"
    even = read(famos.file(Channel("c", X, times=np.arange(400) / 50))).columns[0]
    assert even.dt == pytest.approx(0.02) and even.time == ""


def test_an_axis_that_is_no_time_gives_no_step() -> None:
    table = read(famos.file(Channel("a", X, 0.5, axis_unit="Hz")))
    assert table.columns[0].dt is None and table.notes == ("a is recorded over Hz, in steps of 0.5",)


def test_missing_samples_are_refused_with_both_numbers() -> None:
    with pytest.raises(FileError, match="states a end of its samples of 3300 bytes; the data have 3200 bytes"):
        read(famos.file(Channel("a", X, stated_bytes=3300)))
    raw = famos.file(Channel("a", X))
    for cut in range(20, len(raw), 31):
        assert binaries.read_or_refused(reader.read, raw[:cut], "a.raw") is None


@settings(max_examples=40)
@given(
    st.lists(
        st.tuples(st.lists(st.floats(-1e9, 1e9), min_size=2, max_size=50), st.floats(1e-5, 1.0), st.floats(-5, 500)),
        min_size=1,
        max_size=4,
    ),
    st.sampled_from(["kN", "mm", "°C", "m/s²", "a,b;c"]),
)
def test_any_written_file_gives_its_values_back(records: list[tuple[list[float], float, float]], unit: str) -> None:
    channels = [Channel(f"c,{k};", np.array(v), dt, start, unit) for k, (v, dt, start) in enumerate(records)]
    for column, channel in zip(read(famos.file(*channels)).columns, channels, strict=True):
        np.testing.assert_array_equal(column.values, channel.values)
        assert (column.name, column.unit, column.dt, column.start) == (channel.name, unit, channel.dt, channel.start)


RAW = famos.file(Channel("a", X[:40]), Channel("b", X[:40], times=np.arange(40) ** 1.1))


@settings(max_examples=150)
@given(st.lists(st.tuples(st.integers(0, 10**9), st.integers(0, 255)), max_size=6), st.integers(0, 10**9))
def test_a_damaged_file_is_read_or_refused(changes: list[tuple[int, int]], cut: int) -> None:
    binaries.read_or_refused(reader.read, binaries.damaged(RAW, changes, cut), "a.raw")
