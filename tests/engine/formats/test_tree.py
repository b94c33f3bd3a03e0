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
    st.sampled_from([None, 0.5, 250.0, 4096.0]),
    st.sampled_from([1.0, 0.001, -3.0]),
    st.sampled_from([0.0, 2.5]),
)
def test_any_list_of_channels_comes_back(channels: Any, rate: float | None, scale: float, offset: float) -> None:
    about = {"scale": scale, "offset": offset, **({"rate": rate} if rate else {})}
    table = read({"channels": [{"name": name, "unit": "mm", "data": values, **about} for name, values in channels]})
    assert [one.name for one in table.columns] == [name for name, _ in channels]
    for one, (_, values) in zip(table.columns, channels, strict=True):
        np.testing.assert_allclose(one.values, scale * np.array(values) + offset, rtol=1e-15)
        assert (one.unit, one.dt) == ("mm", 1 / rate if rate else None)
