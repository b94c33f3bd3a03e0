"""What a run leaves: its signals and the measures of them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from rths_engine import metrics
from rths_engine.arrays import Array
from rths_engine.channels import Channel
from rths_engine.ground_motions import Motion
from rths_engine.plan import Plan
from rths_engine.safety import Trip


@dataclass(frozen=True, slots=True)
class Result:
    """Signals (substeps, channels) every `dt` (s) and history (steps + 1, 2, floors) of x and v at integration steps; SI.

    `total` is the number of substeps of the whole test, recorded or not.
    """

    plan: Plan
    motion: Motion
    status: str
    trip: Trip | None
    elapsed_s: float
    dt: float
    total: int
    channels: tuple[Channel, ...]
    signals: Array
    history: Array

    @property
    def simulated_s(self) -> float:
        return len(self.signals) * self.dt

    def signal(self, key: str) -> Array:
        """The column named `key` (`s1.x_cmd`), SI."""
        column: Array = self.signals[:, [channel.key for channel in self.channels].index(key)]
        return column

    def summary(self) -> dict[str, Any]:
        """JSON form: how the run ended, and the measures of each station in the units of the paper's Table IV."""
        floors = [channel.key for channel in self.channels if channel.group == "floors"]
        return {
            "status": self.status,
            "trip": self.trip.as_dict() if self.trip else None,
            "elapsed_s": self.elapsed_s,
            "simulated_s": self.simulated_s,
            "stations": list(self._stations()),
            "floors_peak_mm": [_peak(self.signal(key)) * 1e3 for key in floors],
        }

    def _stations(self) -> Iterator[dict[str, Any]]:
        for number, station in enumerate(self.plan.stations, start=1):
            x_cmd, x_meas, f_meas = (self.signal(f"s{number}.{key}") for key in ("x_cmd", "x_meas", "f_meas"))
            yield {
                "name": station.name,
                "mte_mm": metrics.maximum_tracking_error(x_cmd, x_meas) * 1e3,
                "rms_percent": metrics.rms_tracking_error(x_cmd, x_meas) * 1e2,
                "mti_mm2": metrics.signed_peak(metrics.tracking_indicator(x_cmd, x_meas)) * 1e6,
                "mee_kNm": metrics.signed_peak(metrics.energy_error(x_cmd, x_meas, f_meas)) * 1e-3,
                "peak_stroke_mm": _peak(x_meas) * 1e3,
                "peak_force_kN": _peak(f_meas) * 1e-3,
            }


def _peak(signal: Array) -> float:
    return float(np.max(np.abs(signal), initial=0.0))
