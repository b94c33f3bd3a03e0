"""The measures of a test under way, from the new samples alone: the cost follows the samples, not the length of the record.

At the end they are `result.summary()`'s but for rounding; the frequency evaluation index agrees to 1 % of amplitude and 0.3 ms
where the command has several cycles in a segment (`frequency.RunningFrequency`).
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.planning.plan import Plan
from rths_engine.results.channels import FLOORS, INPUTS, Channel, columns, key
from rths_engine.results.metrics.correlation import RunningCorrelation
from rths_engine.results.metrics.energy import energy_error_ratio, floor_loads, input_energy
from rths_engine.results.metrics.frequency import RunningFrequency
from rths_engine.results.metrics.station import StationMeasures
from rths_engine.results.metrics.tracking import signed_peak


class RunningMeasures:
    """Takes each new part of `Run.signals` (samples, channels) in order; `start`: the floors' displacements at t = 0 (m)."""

    def __init__(self, plan: Plan, channels: tuple[Channel, ...], start: Array):
        self.names = [station.name for station in plan.stations]
        self.dampers = [station.dampers for station in plan.stations]
        places = {channel.key: number for number, channel in enumerate(channels)}
        self._stations = [_Station(places, number, plan.substep) for number in range(1, len(self.names) + 1)]
        self._input = _Input(floor_loads(plan), channels, start)

    @np.errstate(over="ignore", invalid="ignore")
    def take(self, rows: Array) -> None:
        if len(rows):
            self._input.take(rows)
            for station in self._stations:
                station.take(rows)

    @np.errstate(over="ignore", invalid="ignore")
    def shown(self) -> dict[str, Any]:
        """JSON form, as in a run's summary; null for what is no finite number."""
        largest = self._input.largest
        stations = []
        for name, dampers, station in zip(self.names, self.dampers, self._stations, strict=True):
            measures = station.measures()
            stations.append(_finite(measures.shown(name, energy_error_ratio(measures.mee, dampers, largest))))
        return _finite({"input_energy_kNm": None if largest is None else largest * 1e-3}) | {"stations": stations}


class _Input:
    """The largest input energy so far (J); None where it is not known."""

    def __init__(self, loads: Array | None, channels: tuple[Channel, ...], start: Array):
        self.largest = None if loads is None else 0.0
        self._loads = loads
        self._inputs = columns(channels, *INPUTS)
        self._floors = columns(channels, *FLOORS)
        self._start, self._total = start, 0.0
        self._before: Array | None = None

    def take(self, rows: Array) -> None:
        if self._loads is None or self.largest is None:
            return
        inputs, floors = rows[:, self._inputs], rows[:, self._floors]
        energy = self._total + input_energy(self._loads, inputs, floors, self._start, self._before)
        self._start, self._before, self._total = floors[-1], inputs[-1:], float(energy[-1])
        self.largest = max(self.largest, float(np.max(energy)))


class _Station:
    """Sums and extremes of one station."""

    def __init__(self, places: dict[str, int], number: int, dt: float):
        roles = ("x_cmd", "x_meas", "f_meas", "ti", "energy_error")
        self._columns = [places[key(role, number)] for role in roles]
        self._frequency, self._correlation = RunningFrequency(dt), RunningCorrelation(dt)
        self._count, self._lowest, self._highest = 0, math.inf, -math.inf
        self._error_power = self._command_power = 0.0
        self._extremes: Array = np.zeros(5)  # error, TI, energy error, stroke, force: each of largest magnitude, with its sign

    def take(self, rows: Array) -> None:
        x_cmd, x_meas, f_meas, indicator, energy = rows[:, self._columns].T
        error = x_cmd - x_meas
        self._frequency.take(x_cmd, x_meas)
        self._correlation.take(x_cmd, x_meas)
        self._count += len(rows)
        self._lowest, self._highest = min(self._lowest, float(x_cmd.min())), max(self._highest, float(x_cmd.max()))
        self._error_power += float(np.sum(error**2))
        self._command_power += float(np.sum(x_cmd**2))
        new = np.array([signed_peak(signal) for signal in (error, indicator, energy, x_meas, f_meas)])
        self._extremes = np.where(np.abs(new) > np.abs(self._extremes), new, self._extremes)

    def measures(self) -> StationMeasures:
        error, indicator, energy, stroke, force = self._extremes.tolist()
        span, largest = self._highest - self._lowest, max(abs(self._lowest), abs(self._highest))
        return StationMeasures(
            mte=abs(error),
            rms=math.sqrt(self._error_power / self._command_power) if self._command_power > 0 else 0.0,
            mti=indicator,
            mee=energy,
            stroke=abs(stroke),
            force=abs(force),
            frequency=self._frequency.value(),
            normalised_rms=math.sqrt(self._error_power / self._count) / span if self._count and span > 0 else None,
            peak_error=abs(error) / largest if self._count and largest > 0 else None,
            delay=self._correlation.value(),
        )


def _finite(values: dict[str, Any]) -> dict[str, Any]:
    return {name: None if isinstance(value, float) and not math.isfinite(value) else value for name, value in values.items()}
