"""Universal files (dataset 58) come back as an independent writer wrote them, as text and as binary data."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rths_engine.formats.laboratory import uff as reader
from rths_engine.formats.table import Table
from rths_engine.foundation.errors import FileError
from tests.engine.formats import binaries
from tests.engine.formats.writers import uff58
from tests.engine.formats.writers.uff58 import Record

X = 12.5 * np.sin(np.arange(400) / 9)
OTHER = b"    -1\n   151\nmodel\nNONE\nNONE\nNONE\nNONE\nNONE\nNONE\n    -1\n"


def read(raw: bytes) -> Table:
    return binaries.read(raw, "a.uff", "uff58")


@pytest.mark.parametrize("double", [False, True])
@pytest.mark.parametrize("binary", [False, True])
def test_values_step_unit_and_quantity(double: bool, binary: bool) -> None:
    raw = uff58.file(
        Record(X, 0.0009765625, 0.5, double=double, binary=binary, unit="N"),
        Record(X, kind=12, unit="g", point="table"),
        before=OTHER,
    )
    table = read(raw)
    force, acceleration = table.columns
    np.testing.assert_allclose(force.values, X, rtol=1e-11 if double else 1e-5)
    assert force.dt == pytest.approx(9.76562e-4, rel=1e-5)
    assert (force.start, force.unit, force.quantity) == (0.5, "N", "force")
    assert force.name == "actuator Force" and acceleration.quantity == "acceleration"
    assert table.notes == ("datasets 151 contain no time histories",)


def test_uneven_text_takes_the_increment_where_its_stamps_lie_on_it() -> None:
    times = np.arange(300 * 2048) / 2048  # in six digits, a third of these stamps are equal
    column = read(uff58.file(Record(np.sin(times), 1 / 2048, times=times))).columns[0]
    assert len(column.values) == len(times) and column.dt == pytest.approx(1 / 2048, rel=1e-5) and column.time == ""


def test_truly_uneven_stamps_are_a_column_and_equal_stamps_without_an_increment_are_refused() -> None:
    times = np.cumsum(0.1 + 0.05 * np.sin(np.arange(400)))
    stamps, column = read(uff58.file(Record(X, 0.0, times=times, binary=True))).columns
    np.testing.assert_allclose(stamps.values, times, rtol=1e-6)
    assert column.time == stamps.name and column.dt is None
    with pytest.raises(FileError, match=r"has \d+ of 614400 time stamps twice, and no increment"):
        read(uff58.file(Record(np.ones(614_400), 0.0, times=np.arange(614_400) / 2048)))


def test_numbers_that_touch_in_their_fixed_columns_are_read() -> None:
    body = uff58.file(Record([1.0, 2.0, 3.0])).replace(b"  1.00000E+00  2.00000E+00", b"-1.00000E+000-2.00000E+000")
    np.testing.assert_array_equal(read(body).columns[0].values, [-1.0, -2.0, 3.0])


def test_contradictions_are_refused_with_both_numbers() -> None:
    with pytest.raises(FileError, match="states a number of samples of actuator Force of 401; the data have 400"):
        read(uff58.file(Record(X, stated=401)))
    with pytest.raises(FileError, match="states a number of samples of actuator Force of 300; the data have 400"):
        read(uff58.file(Record(X, stated=300, binary=True)))
    with pytest.raises(FileError, match="the binary data do not end where the header says"):
        read(uff58.file(Record(X, binary=True)).replace(b"        1600", b"        1500"))
    with pytest.raises(FileError, match="contains text that is not a number"):
        read(uff58.file(Record(X)).replace(b"  1.38", b"  *.38", 1))


def test_other_functions_are_named() -> None:
    with pytest.raises(FileError, match=r"contains no time history.*is a frequency response: left out"):
        read(uff58.file(Record(X, function=4)))


@settings(max_examples=40)
@given(
    st.lists(st.floats(-1e9, 1e9, allow_subnormal=False), min_size=2, max_size=60),
    st.sampled_from([0.01, 0.001, 0.0005, 1 / 4096]),
    st.booleans(),
    st.booleans(),
)
def test_any_written_record_gives_its_values_back(values: list[float], dt: float, double: bool, binary: bool) -> None:
    column = read(uff58.file(Record(values, dt, double=double, binary=binary))).columns[0]
    np.testing.assert_allclose(column.values, values, rtol=1e-11 if double else 1e-5, atol=1e-30)
    assert column.dt == pytest.approx(dt, rel=1e-5)


RAW = uff58.file(Record(X[:40]), Record(X[:40], binary=True, double=True, point="b"))


@settings(max_examples=100)
@given(st.lists(st.tuples(st.integers(0, 10**9), st.integers(0, 255)), max_size=6), st.integers(0, 10**9))
def test_a_damaged_file_is_read_or_refused(changes: list[tuple[int, int]], cut: int) -> None:
    binaries.read_or_refused(reader.read, binaries.damaged(RAW, changes, cut), "a.uff")


def test_no_cut_of_a_file_is_read_with_other_values() -> None:
    for cut in range(20, len(RAW), 7):
        found = binaries.read_or_refused(reader.read, RAW[:cut], "a.uff")
        assert found is None or [len(one.values) for one in found.columns] in ([40], [40, 40])
