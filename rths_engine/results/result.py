"""What a run leaves: its signals and the measures of them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.parts.ground_motions import Motion
from rths_engine.planning.plan import Plan
from rths_engine.planning.safety import Trip
from rths_engine.results import metrics
from rths_engine.results.channels import FLOORS, INPUTS, Channel, columns, key


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
        """The column named `key` (`x_cmd.1`), SI."""
        column: Array = self.signals[:, [channel.key for channel in self.channels].index(key)]
        return column

    def summary(self) -> dict[str, Any]:
        """JSON form: how the run ended, the measures of each station, floor peaks and the largest input energy."""
        largest_input = self._largest_input()
        return {
            "status": self.status,
            "trip": self.trip.as_dict() if self.trip else None,
            "elapsed_s": self.elapsed_s,
            "simulated_s": self.simulated_s,
            "stations": list(self._stations(largest_input)),
            "floors_peak_mm": [float(np.max(np.abs(x), initial=0.0)) * 1e3 for x in self._columns(*FLOORS).T],
            "input_energy_kNm": None if largest_input is None else largest_input * 1e-3,
        }

    def _stations(self, largest_input: float | None) -> Iterator[dict[str, Any]]:
        for number, station in enumerate(self.plan.stations, start=1):
            x_cmd, x_meas, f_meas = (self.signal(key(role, number)) for role in ("x_cmd", "x_meas", "f_meas"))
            measures = metrics.station_measures(x_cmd, x_meas, f_meas, self.dt)
            yield measures.shown(station.name, metrics.energy_error_ratio(measures.mee, station.dampers, largest_input))

    def _largest_input(self) -> float | None:
        """The largest input energy (J); None where it is not known."""
        loads = metrics.floor_loads(self.plan)
        if loads is None:
            return None
        energy = metrics.input_energy(loads, self._columns(*INPUTS), self._columns(*FLOORS), self.history[0, 0])
        return float(np.max(energy, initial=0.0))

    def _columns(self, *roles: str) -> Array:
        return self.signals[:, columns(self.channels, *roles)]
