"""The measures of a whole record, in shown units; None where a measure is not defined or not finite."""

from __future__ import annotations

from typing import Any

import numpy as np

from rths_engine.results.measure import FloorMeasure, RunMeasure, StationMeasure
from rths_engine.results.measures import of
from rths_engine.results.signals import RunSignals, StationSignals


@np.errstate(over="ignore", invalid="ignore")
def of_station(signals: StationSignals) -> dict[str, float | None]:
    """Every measure of a station by its key."""
    return {one.key: one.in_shown(one.compute(signals)) for one in of(StationMeasure)}


@np.errstate(over="ignore", invalid="ignore")
def of_run(signals: RunSignals) -> dict[str, Any]:
    """JSON form: `stations`, each with its name and measures; then the measures of floors, a list each, and of the test."""
    stations = [
        {"name": station.name} | of_station(signals.station(number))
        for number, station in enumerate(signals.plan.stations, start=1)
    ]
    floors = {one.key: [one.in_shown(value) for value in one.compute(signals)] for one in of(FloorMeasure)}
    return {"stations": stations} | floors | {one.key: one.in_shown(one.compute(signals)) for one in of(RunMeasure)}
