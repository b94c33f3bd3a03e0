"""The data that measures are computed from: the whole record of a test and of each station, in SI."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.planning.model import Model
from rths_engine.planning.plan import Plan
from rths_engine.results import metrics, reference
from rths_engine.results.channels import FLOORS, INPUTS, RECORDED, Channel, columns, key


@dataclass(frozen=True)
class StationSignals:
    """One station's channels by role, each (samples), every `dt` (s).

    `dampers` equal specimens stand in the station's storey. `largest_input` is the largest input energy (J) of the test, None
    where it is not known. `reference` (samples) is the stroke of the whole structure's reference, None where there is none.
    """

    channels: Mapping[str, Array]
    dt: float
    dampers: int = 1
    largest_input: float | None = None
    reference: Array | None = None

    @property
    def x_cmd(self) -> Array:
        return self.channels["x_cmd"]

    @property
    def x_meas(self) -> Array:
        return self.channels["x_meas"]

    @property
    def f_meas(self) -> Array:
        return self.channels["f_meas"]

    def to_reference(self, error: Callable[[Array, Array], float | None]) -> float | None:
        """An error of the measured displacement against the reference; None without a reference."""
        return None if self.reference is None else error(self.reference, self.x_meas)

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

    @cached_property
    def reference(self) -> Array | None:
        """(samples, DOF): displacements of the whole structure, computed apart; None where it is not linear."""
        return reference.response(self.model, self.inputs, self.dt)

    def floors_to_reference(self, error: Callable[[Array, Array], float | None]) -> list[float]:
        """An error of each floor against the reference; empty without a reference, NaN where it is not defined."""
        if self.reference is None:
            return []
        pairs = zip(self.reference[:, list(self.model.built.floors)].T, self.floors.T, strict=True)
        return [math.nan if (found := error(whole, own)) is None else found for whole, own in pairs]

    def station(self, number: int) -> StationSignals:
        """The record of station `number`, which counts from 1."""
        own = {role: self.signal(key(role, number)) for role in RECORDED}
        stroke = None if self.reference is None else self.reference @ self.model.drifts[number - 1]
        return StationSignals(own, self.dt, self.plan.stations[number - 1].dampers, self.largest_input, stroke)
