"""Recordings and results of sweeps as NumPy arrays and DataFrames."""

from __future__ import annotations

import io
import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import h5py
import numpy as np
from numpy.typing import NDArray

from rths.errors import ClientError

Array = NDArray[np.float64]


def _pandas() -> Any:
    try:
        import pandas
    except ImportError:
        raise ClientError("a DataFrame needs pandas: pip install pandas. Arrays need NumPy only.") from None
    return pandas


@dataclass(frozen=True, slots=True)
class Recording:
    """The recording of a run in SI units: `recording["x_meas.1"]` is the measured displacement (m) of station 1.

    `time` (s) has one value for each sample; `units` has the SI unit of each channel, by its key; `plan` and `summary` are the
    plan and the measures of the run.
    """

    time: Array
    channels: Mapping[str, Array]
    units: Mapping[str, str]
    plan: Mapping[str, Any]
    summary: Mapping[str, Any]

    @classmethod
    def of(cls, file: bytes) -> Recording:
        """A recording from the bytes of its HDF5 file, `rths-recording/2`."""
        with h5py.File(io.BytesIO(file), "r") as opened:
            described = json.loads(opened.attrs["channels"])
            signals = opened["signals"][:]
            dt = float(opened.attrs["dt"])
            plan, summary = json.loads(opened["plan"][()]), json.loads(opened.attrs["summary"])
        keys = [one["key"] for one in described]
        return cls(
            np.arange(1.0, len(signals) + 1.0) * dt,
            {key: signals[:, column] for column, key in enumerate(keys)},
            {one["key"]: one["unit"] for one in described},
            plan,
            summary,
        )

    def __getitem__(self, key: str) -> Array:
        try:
            return self.channels[key]
        except KeyError:
            raise ClientError(f"the recording has no channel {key!r}; it has {', '.join(self.channels)}") from None

    def dataframe(self) -> Any:
        """The channels as columns `KEY [UNIT]` of a pandas DataFrame, indexed by time (s)."""
        columns = {f"{key} [{self.units[key]}]": values for key, values in self.channels.items()}
        return _pandas().DataFrame(columns, index=_pandas().Index(self.time, name="time [s]"))


@dataclass(frozen=True, slots=True)
class SweepResults:
    """Results of the points of a sweep in columns: `results["mte_mm.1"]`. `columns` declares label and unit of each."""

    values: Mapping[str, Sequence[Any]]
    columns: Sequence[Mapping[str, Any]]

    def __getitem__(self, key: str) -> Array:
        """A numeric column, NaN where a point has no value."""
        try:
            column = self.values[key]
        except KeyError:
            raise ClientError(f"the sweep has no column {key!r}; it has {', '.join(self.values)}") from None
        return np.array([np.nan if value is None else value for value in column], dtype=float)

    def dataframe(self) -> Any:
        """The columns as a pandas DataFrame with one row for each point."""
        return _pandas().DataFrame({key: list(column) for key, column in self.values.items()})
