"""The measures of a test while it runs."""

from __future__ import annotations

from typing import Any

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.planning.model import Model
from rths_engine.planning.plan import Plan
from rths_engine.results.channels import Channel
from rths_engine.results.measure import RunMeasure, StationMeasure
from rths_engine.results.measures import of
from rths_engine.results.sums import RunSums


class RunningMeasures:
    """Takes each new part of `Run.signals` (samples, channels) in order; `start`: the floors' displacements at t = 0 (m)."""

    def __init__(self, planned: Plan | Model, channels: tuple[Channel, ...], start: Array):
        model = Model.of(planned)
        self.names = [station.name for station in model.plan.stations]
        self._sums = RunSums(model, channels, start)

    @np.errstate(over="ignore", invalid="ignore")
    def take(self, rows: Array) -> None:
        if len(rows):
            self._sums.take(rows)

    @np.errstate(over="ignore", invalid="ignore")
    def shown(self) -> dict[str, Any]:
        """JSON form, as in a run's summary; null for a value that is not finite, or is computed only at the end."""
        stations = [
            {"name": name} | {one.key: one.so_far and one.in_shown(one.so_far(sums)) for one in of(StationMeasure)}
            for name, sums in zip(self.names, self._sums.stations, strict=True)
        ]
        whole = {one.key: one.so_far and one.in_shown(one.so_far(self._sums)) for one in of(RunMeasure)}
        return {"stations": stations} | whole
