"""Nested data: channels in a list, and attributes that scale, shift and time the samples, applied once and said."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rths_engine.formats import registry, tree
from rths_engine.formats.source import Source
from rths_engine.formats.table import Table
from rths_engine.foundation.errors import FileError

X = [0.0, 1.5, -3.0, 2.25]


def read(body: Any) -> Table:
    return registry.read(Source("test.json", content=json.dumps(body).encode()))


def column(**item: Any) -> Any:
    return read({"channels": [{"name": "force", "data": X, **item}]}).names["force"]


@pytest.mark.parametrize(
    "body",
    [
        {
            "channels": [
                {"name": "force", "unit": "kN", "rate": 250, "data": X},
                {"name": "disp", "unit": "mm", "dt": 0.004, "data": X},
            ]
        },
        {"rate": 250, "channels": [{"name": "force", "unit": "kN", "data": X}, {"name": "disp", "unit": "mm", "values": X}]},
        [{"label": "force", "unit": "kN", "fs": "250 Hz", "y": X}, {"label": "disp", "unit": "mm", "dt_ms": 4, "y": X}],
        {
            "signals": [
                {"name": "force", "meta": {"unit": "kN", "dt": "4 ms"}, "data": X},
                {"id": "disp", "units": "mm", "rate_khz": 0.25, "data": X},
            ]
        },
    ],
)
def test_channels_in_a_list_are_columns_with_their_own_name_unit_and_step(body: Any) -> None:
    table = read(body)
    assert [(one.name, one.unit, one.dt) for one in table.columns] == [("force", "kN", 0.004), ("disp", "mm", 0.004)]
    assert all(one.values.tolist() == X for one in table.columns)


def test_channels_of_one_name_and_without_a_name_stay_apart() -> None:
    table = read({"test": {"channels": [{"name": "a", "data": X}, {"name": "a", "data": X}, {"data": X}]}})
    assert list(table.names) == ["test/a", "test/a~2", "test/channels/3"]


def test_rates_and_starts_differ_between_channels() -> None:
    table = read([{"name": "a", "rate": 100, "t0": 0.5, "data": X}, {"name": "b", "rate": 1024, "t0_ms": -20, "data": X}])
    assert [(one.dt, one.start) for one in table.columns] == [(0.01, 0.5), (1 / 1024, -0.02)]


@pytest.mark.parametrize(
    ("attributes", "values", "unit", "said"),
    [
        ({"unit": "mm", "scale_factor": 0.001}, [0.001 * x for x in X], "mm", "stored value x 0.001 (scale_factor)"),
        (
            {"unit": "mm", "scale_factor": 2, "add_offset": -1},
            [2 * x - 1 for x in X],
            "mm",
            "stored value x 2 (scale_factor) + -1 (add_offset)",
        ),
        ({"unit": "V", "gain": "20 kN/V"}, [20 * x for x in X], "kN", "stored value x 20 kN/V (gain)"),
        ({"unit": "mV", "gain": 20, "gain_unit": "kN/V"}, [0.02 * x for x in X], "kN", "stored value x 20 kN/V (gain)"),
        ({"unit": "V", "calibration": "2.5 kN/V"}, [2.5 * x for x in X], "kN", "stored value x 2.5 kN/V (calibration)"),
        ({"unit": "counts", "gain": "0.5 mm/count"}, [0.5 * x for x in X], "mm", "stored value x 0.5 mm/count (gain)"),
        ({"unit": "V", "sensitivity": "100 mV/g"}, [10 * x for x in X], "g", "stored value / (100 mV/g) (sensitivity)"),
        (
            {"unit": "V", "sensitivity": 0.1, "sensitivity_unit": "V/g"},
            [10 * x for x in X],
            "g",
            "stored value / (0.1 V/g) (sensitivity)",
        ),
        ({"unit": "mm", "scale": 1, "offset": 0}, X, "mm", ""),
    ],
)
def test_scale_gain_offset_and_sensitivity_are_applied_and_said(attributes: Any, values: Any, unit: str, said: str) -> None:
    found = column(**attributes)
    np.testing.assert_allclose(found.values, values, rtol=1e-14)
    assert (found.unit, found.applied) == (unit, said)


@pytest.mark.parametrize(
    ("attributes", "note"),
    [
        ({"unit": "kN", "sensitivity": 2.0}, "force: sensitivity = 2 is not applied: its unit, such as mV/g, is not stated"),
        ({"unit": "g", "sensitivity": "100 mV/g"}, "force: sensitivity = 100 mV/g is not applied: the values are in g"),
        ({"unit": "mm", "gain": "20 kN/V"}, "force: gain = 20 kN/V is not applied: the values are in mm"),
        ({"unit": "V", "calibration": 2.5}, "force: calibration = 2.5 is not applied: its unit, such as kN/V, is not stated"),
        ({"unit": "kN", "scale": 0}, "force: scale is not applied: it has 1 values, or is 0"),
        ({"unit": "V", "gain": 10}, "force: gain = 10 is not applied: the values are in V, and its unit is not stated"),
        ({"tare": 0.2}, "force: tare = 0.2 is not subtracted: state it as the offset of the column where it applies"),
    ],
)
def test_an_attribute_whose_meaning_is_not_stated_is_named_and_the_values_stay(attributes: Any, note: str) -> None:
    table = read([{"name": "force", "data": X, **attributes}])
    assert table.names["force"].values.tolist() == X and table.notes == (note,)


def test_a_factor_beside_several_arrays_is_not_applied_to_any() -> None:
    table = read({"gain": 2.0, "x": X, "f": X})
    assert [one.values.tolist() for one in table.columns] == [X, X]
    assert table.notes == ("gain not applied: it is not stated to which array it belongs",)


def test_a_factor_for_each_column_of_a_matrix() -> None:
    matrix = np.arange(12.0).reshape(6, 2)
    found = tree.table({"m": {"data": matrix, "scale": np.array([2.0, 10.0]), "unit": "mm"}}, "test").columns
    assert [one.name for one in found] == ["m.1", "m.2"]
    assert np.array_equal(np.column_stack([one.values for one in found]), matrix * [2, 10])


@pytest.mark.parametrize(
    ("attributes", "unit"),
    [
        ({"unit": "V", "sensitivity": "2 V/kN", "offset": "1 V"}, "V"),
        ({"unit": "mm", "gain": 0.001, "offset": 2000}, "count"),
        ({"unit": "mm", "scale_factor": 0.001, "Offset": -3.0}, "count"),
        ({"unit": "mm", "offset": 3}, ""),
        ({"gain": "20 kN/V", "unit": "mV", "offset": 0.2}, "mV"),
    ],
)
def test_an_offset_whose_sign_and_place_no_convention_states_is_asked_for(attributes: Any, unit: str) -> None:
    table = read([{"name": "force", "data": X, **attributes}])
    found = table.names["force"]
    assert (found.values.tolist(), found.unit, found.applied) == (X, unit, "")
    assert "it is not stated whether the offset is added or subtracted" in table.notes[0] and "ffset = " in table.notes[0]


@pytest.mark.parametrize(
    ("attributes", "values"),
    [
        ({"missing_value": -999}, [1.0, np.nan, 2.0]),
        ({"_FillValue": -999.0}, [1.0, np.nan, 2.0]),
        ({"nodata": [-999, 2]}, [1.0, np.nan, np.nan]),
        ({"fillValue": "-999", "scale": 0.5}, [0.5, np.nan, 1.0]),
    ],
)
def test_samples_that_an_attribute_marks_as_missing_are_missing(attributes: Any, values: Any) -> None:
    table = read([{"name": "force", "data": [1, -999, 2], **attributes}])
    np.testing.assert_array_equal(table.names["force"].values, values)
    assert table.notes == (f"force: {int(np.isnan(values).sum())} of 3 samples are missing by its attributes",)


def test_a_mark_of_missing_samples_is_valid_for_everything_below_it() -> None:
    table = read({"nan_value": -999, "data": {"x": [1, -999, 2], "f": [3, 4, -999]}})
    np.testing.assert_array_equal([one.values for one in table.columns], [[1, np.nan, 2], [3, 4, np.nan]])


@pytest.mark.parametrize(
    ("stated", "dt"),
    [
        ({"dt": 4, "dt_unit": "ms"}, 0.004),
        ({"dt": "4", "dtUnits": "ms"}, 0.004),
        ({"sampling_period": 4000.0, "unit_of_sampling_period": "us"}, 0.004),
        ({"rate": 0.25, "rate_unit": "kHz"}, 0.004),
        ({"dt": 4, "time_unit": "ms"}, 0.004),
        ({"dt": "0.004"}, 0.004),
        ({"sampling_period": 4}, None),
        ({"dt": 4.0}, None),
        ({"rate": 0.25}, None),
        ({"dt": 4, "dt_unit": "mm"}, None),
        ({"dt_ms": 4, "dt_ms_unit": "s"}, None),
        ({"dt": 0.004, "time_unit": "ms"}, None),
    ],
)
def test_a_step_is_taken_with_its_stated_unit_and_asked_for_without_one(stated: Any, dt: float | None) -> None:
    table = read({**stated, "force_kN": X, "disp_mm": X})
    assert [one.dt for one in table.columns] == [dt, dt]
    assert (dt is not None) == (table.notes == ()) and all(" is not used: " in note for note in table.notes)


N = 64
RAMP = [0.5 * k * (-1) ** k for k in range(N)]
TIME = [0.004 * k for k in range(N)]


@pytest.mark.parametrize(
    ("body", "told"),
    [
        ({"rate": 500, "time": TIME, "f": RAMP}, "rate: states a time step of time of 0.002 s; the data have 0.004 s"),
        ({"fs": 200, "t": TIME, "f": RAMP}, "fs: states a time step of t of 0.005 s; the data have 0.004 s"),
        (
            {"fs": 500, "time_ms": [4 * k for k in range(N)], "f": RAMP},
            "a time step of time_ms of 0.002 s; the data have 0.004 s",
        ),
        (
            {"meta": {"fs": 500}, "time": {"data": TIME, "unit": "s"}, "f": {"data": RAMP, "unit": "kN"}},
            "fs: states a time step of time of 0.002 s; the data have 0.004 s",
        ),
        (
            {"sampling_rate": 500, "daq": {"time": {"values": [4 * k for k in range(N)], "unit": "ms"}, "f": RAMP}},
            "sampling_rate: states a time step of time of 0.002 s; the data have 0.004 s",
        ),
        ({"n_samples": 65, "daq": {"x": RAMP, "f": RAMP}}, "n_samples: states a number of samples of 65; the data have 64"),
        ({"daq": {"npts": 65, "x": RAMP, "f": RAMP}}, "npts: states a number of samples of daq of 65; the data have 64"),
        ({"fs": 250, "N": 65, "x": RAMP, "f": RAMP}, "N: states a number of samples of 65; the data have 64"),
        ({"fs": 250, "n": 60, "data": {"x": RAMP, "f": RAMP}}, "n: states a number of samples of 60; the data have 64"),
        ({"fs": 250, "duration": 9.0, "x": RAMP, "f": RAMP}, "duration: states a duration of 9 s; the data have 0.254 s"),
        ({"f": {"data": RAMP, "unit": "kN", "peak": 25}}, "peak: states a peak of f of 25 kN; the data have 31.5 kN"),
        ({"f": {"data": RAMP, "unit": "kN", "peak": "25000 N"}}, "peak: states a peak of f of 25 kN; the data have 31.5 kN"),
    ],
)
def test_what_is_stated_around_the_arrays_is_compared_with_them(body: Any, told: str) -> None:
    with pytest.raises(FileError) as refusal:
        read(body)
    assert told in str(refusal.value)


@pytest.mark.parametrize(
    "body",
    [
        {"rate": 250, "time": TIME, "f": RAMP, "n_samples": N, "duration": 0.256},
        {"fs": 250, "t": [4 * k for k in range(N)], "f": RAMP, "N": N},
        {"fs": 256, "time": [round(k / 256, 4) for k in range(N)], "f": RAMP},
        {"fs": 250, "time": [*TIME[:-1], 9.0], "f": RAMP},  # a gap
        {"fs": 250, "n": 3, "x": RAMP, "f": RAMP, "NFFT": 128},
        {"fs": 250, "N": 1024, "x": RAMP, "f": RAMP},
        {"fs": 250, "samples": 2 * N, "x": RAMP, "f": RAMP},
        {"npts": N, "a": {"data": RAMP, "dt": 0.01}, "b": {"data": RAMP[:32], "dt": 0.02}},
        {"f": {"data": RAMP, "unit": "kN", "peak": -31.5}},
        {"fs": 250, "period": {"data": [0.1 * k + 0.1 for k in range(N)], "unit": "s"}, "f": RAMP},
    ],
)
def test_what_is_stated_rightly_refuses_nothing(body: Any) -> None:
    assert read(body).columns


def test_units_stand_in_an_object_by_the_names_of_the_arrays() -> None:
    table = read({"fs": 250, "data": {"force": X, "disp": X, "note": X}, "units": {"force": "kN", "disp": "mm"}})
    assert [(one.name, one.unit) for one in table.columns] == [("data/force", "kN"), ("data/disp", "mm"), ("data/note", "")]


@pytest.mark.parametrize(
    ("attributes", "told"),
    [
        ({"npts": 5}, "npts: states a number of samples of force of 5; the data have 4"),
        ({"dt": 0.01, "rate": 250}, "dt: states a time step of 0.01 s; rate states 250 Hz, so 0.004 s"),
        ({"dt": 0.01, "duration": 4.0}, "duration: states a duration of force of 4 s; the data have 0.035 s"),
        ({"dt": 0.01, "time": [0, 0.02, 0.04, 0.06]}, "dt: states a time step of time of 0.01 s; the data have 0.02 s"),
        ({"scale": 2, "gain": 3}, "scale and gain: both multiply the values"),
    ],
)
def test_attributes_that_contradict_each_other_or_the_data_refuse_the_file(attributes: Any, told: str) -> None:
    with pytest.raises(FileError) as refusal:
        column(**attributes)
    assert told in str(refusal.value)


names = st.text("abcdefXYZ", min_size=1, max_size=8)
numbers = st.lists(st.floats(-1e6, 1e6, width=32), min_size=2, max_size=20)


@given(
    st.lists(st.tuples(names, numbers), min_size=1, max_size=5, unique_by=lambda one: one[0]),
    st.sampled_from([None, 12.5, 250.0, 4096.0]),
    st.sampled_from([1.0, 0.001, -3.0]),
    st.sampled_from([0.0, 2.5]),
)
def test_any_list_of_channels_comes_back(channels: Any, rate: float | None, scale: float, offset: float) -> None:
    about = {"scale": scale, "add_offset": offset, **({"rate": rate} if rate else {})}
    table = read({"channels": [{"name": name, "unit": "mm", "data": values, **about} for name, values in channels]})
    assert [one.name for one in table.columns] == [name for name, _ in channels]
    for one, (_, values) in zip(table.columns, channels, strict=True):
        np.testing.assert_allclose(one.values, scale * np.array(values) + offset, rtol=1e-15)
        assert (one.unit, one.dt) == ("mm", 1 / rate if rate else None)
