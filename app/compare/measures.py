"""The measures of the items with their differences to the reference."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np

from app.compare.items import Item
from app.compare.schemas import DifferenceOut, MeasureOut
from app.models import Run
from rths_engine.foundation.arrays import Array
from rths_engine.results.channels import key
from rths_engine.results.measure import FloorMeasure, Measure, RunMeasure, StationMeasure
from rths_engine.results.measures import of
from rths_engine.results.signals import StationSignals

MEASURED = ("x_cmd", "x_meas", "f_meas")  # roles that the measures of a station are computed from
LARGEST = 2_000_000  # samples of an imported recording whose measures are computed for a comparison

Values = dict[str, float | None]


def measures(items: Sequence[Item], reference: int) -> list[MeasureOut]:
    """Every measure that at least one item has: stations, floors, whole test."""
    return [row for where, one, values in _rows(items) if (row := _row(where, one, values, reference))]


def too_long(item: Item) -> bool:
    """Whether an imported recording is too long to compute its measures."""
    return item.run is None and item.recording.samples > LARGEST


def _row(where: str, one: Measure, values: list[float | None], reference: int) -> MeasureOut | None:
    if all(value is None for value in values):
        return None
    base = values[reference]
    return MeasureOut(
        where=where,
        key=one.key,
        label=one.label,
        meaning=f"{one.meaning}: {one.formula}",
        unit=one.shown_label,
        further=one.further,
        values=values,
        differences=[None if k == reference else _difference(value, base) for k, value in enumerate(values)],
    )


def _difference(value: float | None, base: float | None) -> DifferenceOut | None:
    if value is None or base is None:
        return None
    return DifferenceOut(absolute=value - base, percent=100 * (value - base) / abs(base) if base else None)


def _rows(items: Sequence[Item]) -> Iterator[tuple[str, Measure, list[float | None]]]:
    stations = [_stations(one) for one in items]
    for number in range(1, max(map(len, stations), default=0) + 1):
        for station in of(StationMeasure):
            found = [one[number - 1].get(station.key) if number <= len(one) else None for one in stations]
            yield f"Station {number}", station, found
    runs = [one.run for one in items]
    floors = max((len(_floor(run, one)) for run in runs for one in of(FloorMeasure)), default=0)
    for number in range(1, floors + 1):
        for floor in of(FloorMeasure):
            lists = [_floor(run, floor) for run in runs]
            yield f"Floor {number}", floor, [one[number - 1] if number <= len(one) else None for one in lists]
    for whole in of(RunMeasure):
        yield "Whole test", whole, [getattr(run, whole.key) if run and run.test in whole.tests else None for run in runs]


def _floor(run: Run | None, one: FloorMeasure) -> list[float | None]:
    return (getattr(run, one.key) or []) if run and run.test in one.tests else []


def _stations(item: Item) -> list[Values]:
    """The measures of each station: stored for a run, computed for an imported recording."""
    if item.run:
        own = of(StationMeasure, item.run.test)
        return [{one.key: station.measure(one.key) for one in own} for station in item.run.stations]
    last = max((number for number, _ in item.stations), default=0)
    return [_computed(item, number) for number in range(1, last + 1)]


@np.errstate(over="ignore", invalid="ignore", divide="ignore")
def _computed(item: Item, number: int) -> Values:
    if too_long(item):
        return {}
    names = {role: key(role, number) for role in MEASURED}
    read = item.recording.read(list(names.values()))
    channels: dict[str, Array] = {role: read[name] for role, name in names.items() if name in read}
    signals = StationSignals(channels, item.recording.dt)
    return {one.key: _value(one, signals) for one in of(StationMeasure, item.row.test)}


def _value(one: StationMeasure, signals: StationSignals) -> float | None:
    try:
        found = one.in_shown(one.compute(signals))
    except KeyError:  # a channel was not measured
        return None
    return found if found is None or math.isfinite(found) else None
