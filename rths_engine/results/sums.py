"""The data that measures of a running test are computed from: sums and extremes over the samples so far, in SI.

The time of an update depends on the number of new samples, not on the length of the record. At the end the measures equal those
of the whole record except for rounding. The frequency evaluation index agrees within 1 % of amplitude and 0.3 ms where the
command has several cycles in a segment (`metrics.frequency.RunningFrequency`).
"""

from __future__ import annotations

import math

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.planning.model import Model
from rths_engine.results import metrics
from rths_engine.results.channels import FLOORS, INPUTS, Channel, columns, key
from rths_engine.results.metrics.correlation import RunningCorrelation
from rths_engine.results.metrics.frequency import RunningFrequency

_READ = ("x_cmd", "x_meas", "f_meas", "ti", "energy_error")


class RunSums:
    """Sums of a whole test. `largest_input` is the largest input energy so far (J), None where it is not known.

    `start` (floors): displacements at t = 0 (m).
    """

    def __init__(self, model: Model, channels: tuple[Channel, ...], start: Array):
        self._loads = model.floor_loads
        self.largest_input = None if self._loads is None else 0.0
        self._inputs, self._floors = columns(channels, *INPUTS), columns(channels, *FLOORS)
        self._last, self._total = start, 0.0
        self._before: Array | None = None
        places = {channel.key: column for column, channel in enumerate(channels)}
        self.stations = [
            StationSums(self, [places[key(role, number)] for role in _READ], model.plan.substep, station.dampers)
            for number, station in enumerate(model.plan.stations, start=1)
        ]

    def take(self, rows: Array) -> None:
        """Add the next rows (samples, channels) of the record."""
        if self._loads is not None and self.largest_input is not None:
            inputs, floors = rows[:, self._inputs], rows[:, self._floors]
            energy = self._total + metrics.input_energy(self._loads, inputs, floors, self._last, self._before)
            self._last, self._before, self._total = floors[-1], inputs[-1:], float(energy[-1])
            self.largest_input = max(self.largest_input, float(np.max(energy)))
        for station in self.stations:
            station.take(rows)


class StationSums:
    """Sums of one station.

    `error`, `indicator`, `energy`, `stroke` and `force` are the tracking error (m), tracking indicator (m^2), energy error (J),
    measured displacement (m) and measured force (N) of largest magnitude, with their signs. `error_power` and `command_power`
    are sums of squares (m^2) over `count` samples; `lowest` and `highest` bound the command (m).
    """

    def __init__(self, run: RunSums, columns: list[int], dt: float, dampers: int):
        self._run, self._columns, self.dampers = run, columns, dampers
        self._frequency, self._correlation = RunningFrequency(dt), RunningCorrelation(dt)
        self._evaluation: metrics.Evaluation | None = None
        self._evaluated = True
        self.count, self.lowest, self.highest = 0, math.inf, -math.inf
        self.error_power = self.command_power = 0.0
        self.error = self.indicator = self.energy = self.stroke = self.force = 0.0

    def take(self, rows: Array) -> None:
        """Add the next rows (samples, channels) of the record."""
        x_cmd, x_meas, f_meas, indicator, energy = rows[:, self._columns].T
        error = x_cmd - x_meas
        self._frequency.take(x_cmd, x_meas)
        self._evaluated = False
        self._correlation.take(x_cmd, x_meas)
        self.count += len(rows)
        self.lowest, self.highest = min(self.lowest, float(x_cmd.min())), max(self.highest, float(x_cmd.max()))
        self.error_power += float(np.sum(error**2))
        self.command_power += float(np.sum(x_cmd**2))
        self.error = _larger(self.error, error)
        self.indicator = _larger(self.indicator, indicator)
        self.energy = _larger(self.energy, energy)
        self.stroke = _larger(self.stroke, x_meas)
        self.force = _larger(self.force, f_meas)

    @property
    def largest_command(self) -> float:
        """Largest magnitude of the command (m); 0 before the first sample."""
        return max(abs(self.lowest), abs(self.highest)) if self.count else 0.0

    @property
    def span(self) -> float:
        """Range of the command (m); 0 before the first sample."""
        return self.highest - self.lowest if self.count else 0.0

    @property
    def largest_input(self) -> float | None:
        """The largest input energy of the test so far (J); None where it is not known."""
        return self._run.largest_input

    @property
    def evaluation(self) -> metrics.Evaluation | None:
        """Frequency evaluation index so far, evaluated once after each part of the record."""
        if not self._evaluated:
            self._evaluation, self._evaluated = self._frequency.value(), True
        return self._evaluation

    @property
    def delay(self) -> float | None:
        """Delay by cross-correlation so far (s)."""
        return self._correlation.value()


def _larger(before: float, new: Array) -> float:
    peak = metrics.signed_peak(new)
    return peak if abs(peak) > abs(before) else before
