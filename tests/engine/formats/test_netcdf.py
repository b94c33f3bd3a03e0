"""NetCDF 3 files of an independent writer, and NetCDF 4 files, by the conventions CF: packing, missing values, times."""

from __future__ import annotations

import io
from typing import Any

import h5py
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rths_engine.formats.laboratory import netcdf as reader
from rths_engine.formats.table import Table
from rths_engine.foundation.errors import FileError
from tests.engine.formats import binaries
from tests.engine.formats.writers import netcdf3
from tests.engine.formats.writers.netcdf3 import Variable

X = 12.5 * np.sin(np.arange(400) / 9)
PACKED = np.round(X / 0.01).astype("i2")
TIME = Variable("time", 86400.0 + np.arange(400) / 250, ("time",), {"units": "seconds since 2024-05-06 07:08:09"})


def read(raw: bytes) -> Table:
    return binaries.read(raw, "a.nc", "netcdf")


def netcdf4(variables: list[Variable]) -> bytes:
    buffer = io.BytesIO()
    with h5py.File(buffer, "w") as file:
        file.attrs["_NCProperties"] = "version=2"
        for one in variables:
            item = file.create_dataset(one.name, data=one.values)
            for name, value in one.attributes.items():
                item.attrs[name] = np.bytes_(value.encode()) if isinstance(value, str) else np.atleast_1d(value)
            if tuple(one.dimensions) == (one.name,):
                item.make_scale(one.name)
        for one in variables:
            for k, name in enumerate(one.dimensions):
                if name != one.name and name in file:
                    file[one.name].dims[k].attach_scale(file[name])
    return buffer.getvalue()


@pytest.mark.parametrize("write", [netcdf3.file, lambda found: netcdf3.file(found, wide=True), netcdf4])
def test_packing_missing_values_and_time_since_a_date(write: Any) -> None:
    stored = PACKED.copy()
    stored[[3, 7]] = -9999
    about = {"units": "kN", "scale_factor": 0.01, "add_offset": 5.0, "_FillValue": np.int16(-9999)}
    table = read(write([TIME, Variable("force", stored, ("time",), about), Variable("disp", X, ("time",), {"units": "mm"})]))
    force, disp = table.names["force"], table.names["disp"]
    assert np.flatnonzero(np.isnan(force.values)).tolist() == [3, 7]
    np.testing.assert_allclose(np.delete(force.values, [3, 7]), np.delete(PACKED * 0.01 + 5.0, [3, 7]), rtol=1e-14)
    assert force.applied == "stored value x 0.01 (scale_factor) + 5 (add_offset)"
    assert (force.unit, force.start, disp.unit) == ("kN", 0.0, "mm")
    assert force.dt == pytest.approx(0.004) and table.about["time since"] == "2024-05-06 07:08:09"


def test_a_value_that_was_never_written_is_missing() -> None:
    stored = PACKED.copy()
    stored[5] = -32767
    table = read(netcdf3.file([TIME, Variable("force", stored, ("time",), {"scale_factor": 0.01, "units": "kN"})]))
    assert np.flatnonzero(np.isnan(table.names["force"].values)).tolist() == [5]
    assert table.notes == ("force: 1 of 400 samples are missing by its attributes",)


def test_several_channels_and_two_clocks() -> None:
    fast = Variable("t", 100.0 + np.arange(1000) / 1000, ("t",), {"units": "s"})
    both = Variable("strain", np.stack([X, 2 * X]), ("gauge", "time"), {"units": "um/m"})
    table = read(netcdf3.file([TIME, fast, both, Variable("force", np.arange(1000.0), ("t",), {"units": "kN"})]))
    np.testing.assert_array_equal(table.names["strain.2"].values, 2 * X)
    assert table.names["strain.1"].dt == pytest.approx(0.004) and table.names["force"].dt == pytest.approx(0.001)
    assert table.names["force"].start == 100.0


def test_whole_numbers_without_sign_and_their_valid_range() -> None:
    about = {"_Unsigned": "true", "valid_range": np.array([0, -6], "i2"), "_FillValue": np.int16(-1)}
    column = read(netcdf3.file([Variable("a", np.array([1, -2, -1, -10], "i2"), ("n",), about)])).columns[0]
    np.testing.assert_array_equal(column.values, [1.0, np.nan, np.nan, 65526.0])


def test_a_stated_range_that_the_data_leave_is_refused_with_both_numbers() -> None:
    about = {"units": "kN", "actual_range": np.array([-12.5, 11.0])}
    with pytest.raises(FileError, match=r"states a largest value of force of 11 kN; the data have 12\.4"):
        read(netcdf3.file([TIME, Variable("force", X, ("time",), about)]))


def test_every_cut_is_refused() -> None:
    raw = netcdf3.file([TIME, Variable("force", X, ("time",), {"units": "kN"})])
    for cut in range(5, len(raw), 37):
        assert binaries.read_or_refused(reader.read, raw[:cut], "a.nc") is None


@settings(max_examples=40)
@given(
    st.lists(st.floats(-1e9, 1e9), min_size=2, max_size=60),
    st.sampled_from([("seconds", 1.0), ("milliseconds", 1e-3), ("ms", 1e-3), ("minutes", 60.0)]),
    st.floats(1e-3, 10.0),
    st.booleans(),
)
def test_any_written_file_gives_its_values_back(values: list[float], unit: tuple[str, float], step: float, wide: bool) -> None:
    time = Variable("time", np.arange(len(values)) * step, ("time",), {"units": f"{unit[0]} since 1970-01-01"})
    column = read(netcdf3.file([time, Variable("force", np.array(values), ("time",), {"units": "kN"})], wide=wide)).columns[0]
    np.testing.assert_array_equal(column.values, values)
    assert (column.name, column.unit) == ("force", "kN") and column.dt == pytest.approx(step * unit[1])


RAW = netcdf3.file([TIME, Variable("force", PACKED, ("time",), {"units": "kN", "scale_factor": 0.01})])


@settings(max_examples=80)
@given(st.lists(st.tuples(st.integers(4, 10**9), st.integers(0, 255)), max_size=5), st.integers(0, 10**9))
def test_a_damaged_file_is_read_or_refused(changes: list[tuple[int, int]], cut: int) -> None:
    binaries.read_or_refused(reader.read, binaries.damaged(RAW, changes, cut), "a.nc")
