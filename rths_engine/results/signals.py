"""The data that measures are computed from: the whole record of a test and of each station, in SI."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.planning.model import Model
from rths_engine.planning.plan import Plan
from rths_engine.results import metrics
from rths_engine.results.channels import FLOORS, INPUTS, RECORDED, Channel, columns, key


@dataclass(frozen=True)
class StationSignals:
    """One station's channels by role, each (samples), every `dt` (s).

    `dampers` equal specimens stand in the station's storey. `largest_input` is the largest input energy (J) of the test, None
    where it is not known.
    """

    channels: Mapping[str, Array]
    dt: float
    dampers: int = 1
    largest_input: float | None = None

    @property
    def x_cmd(self) -> Array:
        return self.channels["x_cmd"]

    @property
    def x_meas(self) -> Array:
        return self.channels["x_meas"]

    @property
    def f_meas(self) -> Array:
        return self.channels["f_meas"]

    @cached_property
    def evaluation(self) -> metrics.Evaluation | None:
        """Frequency evaluation index over the whole record."""
        return metrics.frequency_evaluation(self.x_cmd, self.x_meas, self.dt)

    @cached_property
    def energy_error(self) -> float:
        """Energy error of one specimen (J) at its largest magnitude, with its sign."""
        return metrics.signed_peak(metrics.energy_error(self.x_cmd, self.x_meas, self.f_meas))


@dataclass(frozen=True)
class RunSignals:
    """The signals (samples, channels) of a test every `dt` (s); `start` (floors): displacements at t = 0 (m)."""

    model: Model
    dt: float
    channels: tuple[Channel, ...]
    signals: Array
    start: Array

    @property
    def plan(self) -> Plan:
        return self.model.plan

    def signal(self, key: str) -> Array:
        """The column named `key` (`x_cmd.1`), contiguous. Raises ValueError where there is none."""
        column: Array = self.signals[:, [channel.key for channel in self.channels].index(key)]
        return np.ascontiguousarray(column)

    @cached_property
    def inputs(self) -> Array:
        """(samples, inputs): ground acceleration (m/s^2) and the force on each floor that has one (N)."""
        return self.signals[:, columns(self.channels, *INPUTS)]

    @cached_property
    def floors(self) -> Array:
        """(samples, floors): displacements relative to the ground (m)."""
        return self.signals[:, columns(self.channels, *FLOORS)]

    @cached_property
    def largest_input(self) -> float | None:
        """The largest input energy (J); None where it is not known."""
        loads = self.model.floor_loads
        if loads is None:
            return None
        return float(np.max(metrics.input_energy(loads, self.inputs, self.floors, self.start), initial=0.0))

    def station(self, number: int) -> StationSignals:
        """The record of station `number`, which counts from 1."""
        own = {role: self.signal(key(role, number)) for role in RECORDED}
        return StationSignals(own, self.dt, self.plan.stations[number - 1].dampers, self.largest_input)
