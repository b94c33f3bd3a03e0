"""catman files come back as an independent writer wrote them, in every form of their samples."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rths_engine.formats.laboratory import catman as reader
from rths_engine.formats.table import Table
from rths_engine.foundation.errors import FileError
from tests.engine.formats import binaries
from tests.engine.formats.writers import catman
from tests.engine.formats.writers.catman import Channel

X = 12.5 * np.sin(np.arange(400) / 9)
TIME = Channel("Time  1 - default sample rate", np.arange(400) / 100, "s")


def read(raw: bytes) -> Table:
    return binaries.read(raw, "a.bin", "catman")


@pytest.mark.parametrize(("form", "within"), [(0, 0.0), (1, 1e-6), (2, 25 / 32767)])
def test_every_form_of_samples(form: int, within: float) -> None:
    table = read(catman.file(TIME, Channel("Kraft", X, "kN", form=form)))
    time, force = table.columns
    np.testing.assert_allclose(force.values, X, atol=within)
    assert (force.name, force.unit, force.dt) == ("Kraft", "kN", 0.01) and time.quantity == "time"


def test_the_mark_for_overflow_is_a_missing_value() -> None:
    values = X.copy()
    values[[3, 8]] = -1_000_000.0
    table = read(catman.file(TIME, Channel("a", values)))
    assert np.flatnonzero(np.isnan(table.columns[1].values)).tolist() == [3, 8]
    assert table.notes == ("a: 2 of 400 samples are catman's mark for overflow, -1e+06: they are missing",)


def test_contradictions_are_refused_with_both_numbers() -> None:
    with pytest.raises(FileError, match=r"states a time step of 0.02 s; the data have 0.01 s"):
        read(catman.file(Channel("Time", TIME.values, "s", dt=0.02)))
    with pytest.raises(FileError, match="needs 3208 bytes; the file has 3200"):
        read(catman.file(Channel("a", X, stated=401)))


def test_every_cut_is_refused() -> None:
    raw = catman.file(TIME, Channel("a", X))
    for cut in range(8, len(raw), 61):
        assert binaries.read_or_refused(reader.read, raw[:cut], "a.bin") is None


@settings(max_examples=40)
@given(st.lists(st.lists(st.floats(-9e5, 9e5), min_size=1, max_size=50), min_size=1, max_size=4), st.floats(1e-5, 1.0))
def test_any_written_file_gives_its_values_back(records: list[list[float]], dt: float) -> None:
    channels = [Channel(f"c{k}", values, "µm/m", dt) for k, values in enumerate(records)]
    for column, channel in zip(read(catman.file(*channels)).columns, channels, strict=True):
        np.testing.assert_array_equal(column.values, channel.values)
        assert (column.name, column.unit) == (channel.name, "µm/m") and column.dt == pytest.approx(dt, rel=1e-12)


RAW = catman.file(TIME, Channel("a", X[:40], form=2), Channel("b", X[:40], form=1))


@settings(max_examples=150)
@given(st.lists(st.tuples(st.integers(8, 10**9), st.integers(0, 255)), max_size=6), st.integers(0, 10**9))
def test_a_damaged_file_is_read_or_refused(changes: list[tuple[int, int]], cut: int) -> None:
    binaries.read_or_refused(reader.read, binaries.damaged(RAW, changes, cut), "a.bin")
