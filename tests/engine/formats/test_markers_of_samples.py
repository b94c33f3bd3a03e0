"""Usual marks of missing values are refused in a file of any format, with the column and the sample."""

from __future__ import annotations

import io
import json
from collections.abc import Callable

import h5py
import numpy as np
import pytest
import scipy.io

from rths_engine.formats import registry
from rths_engine.formats.source import Source
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import FileError
from tests.engine.formats.writers import tdms

FORCE = np.round(11.4 * np.sin(0.1 * np.arange(120)), 3)


def as_json(values: Array) -> Source:
    return Source("a.json", content=json.dumps({"rate": 250, "force_kN": values.tolist()}).encode())


def as_hdf5(values: Array) -> Source:
    raw = io.BytesIO()
    with h5py.File(raw, "w") as file:
        file["daq/force"] = values
        file["daq/force"].attrs["unit"] = "kN"
    return Source("a.h5", content=raw.getvalue())


def as_matlab(values: Array) -> Source:
    raw = io.BytesIO()
    scipy.io.savemat(raw, {"fs": 250.0, "force": values, "disp": np.arange(len(values)) * 0.1})
    return Source("a.mat", content=raw.getvalue())


def as_tdms(values: Array) -> Source:
    return Source("a.tdms", content=tdms.file([tdms.Channel("g", "force", values)]))


WRITERS = [as_json, as_hdf5, as_matlab, as_tdms]


@pytest.mark.parametrize("mark", [-999.0, 9999.0, 1e30, -99999.0])
@pytest.mark.parametrize("write", WRITERS)
def test_a_usual_mark_that_stands_out_is_refused_with_its_sample(write: Callable[[Array], Source], mark: float) -> None:
    values = FORCE.copy()
    values[40:43] = mark
    with pytest.raises(FileError) as refusal:
        registry.read(write(values))
    assert "sample 41" in str(refusal.value) and f"{mark:g} (3 times)" in str(refusal.value)


@pytest.mark.parametrize(
    "values",
    [
        FORCE,
        np.where(np.arange(120) == 7, 99.0, np.arange(120) % 3.0),  # codes of a status
        np.full(120, -999.0),
        np.arange(1000.0),
        100 * FORCE + 999.0,
    ],
)
@pytest.mark.parametrize("write", WRITERS)
def test_healthy_columns_pass(write: Callable[[Array], Source], values: Array) -> None:
    assert registry.read(write(values)).columns
