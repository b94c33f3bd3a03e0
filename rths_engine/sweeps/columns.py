"""The columns of a sweep's results, declared once: inputs, intensity measures of the ground motion, outcome, and measures."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass
from typing import Any

from rths_engine.foundation import units
from rths_engine.foundation.errors import PlanError
from rths_engine.planning.model import Model
from rths_engine.planning.plan import Plan
from rths_engine.planning.safety import LIMITS
from rths_engine.results.measure import FloorMeasure, Measure, RunMeasure, StationMeasure
from rths_engine.results.measures import of
from rths_engine.sweeps.axes import Axis
from rths_engine.sweeps.design import RECORD, SCALE, Design
from rths_engine.sweeps.places import with_values

STATUSES = ("completed", "tripped", "invalid", "failed")
IM_DAMPING = 0.05  # of the spectrum of the intensity measure Sa(T1), by definition


@dataclass(frozen=True, slots=True)
class Column:
    """One column. Its values are float64 in the unit `shown`; NaN where there is none, and places in `categories` for text.

    `role` is input, intensity, outcome or measure; `scope` says of what it is a measure (station, floor, run), and `number` of
    which. `measure` is the key of the measure in docs/measures.md.
    """

    key: str
    label: str
    shown: str
    role: str
    scope: str = ""
    number: int | None = None
    name: str = ""
    measure: str = ""
    decimals: int | None = None
    categories: tuple[str, ...] = ()
    si: bool = False
    """Whether stored values are SI: inputs are kept to the bit."""

    def as_dict(self) -> dict[str, Any]:
        return {**asdict(self), "shown_label": units.pretty(self.shown)}


def from_dict(data: Mapping[str, Any]) -> Column:
    """The column of a JSON form."""
    return Column(
        **{**{key: value for key, value in data.items() if key != "shown_label"}, "categories": tuple(data["categories"])}
    )


def columns(design: Design) -> tuple[Column, ...]:
    """The columns of a design, in the order of a row."""
    return (*inputs(design), *_intensity(design), *_outcome(), *_measures(design))


def inputs(design: Design) -> Iterator[Column]:
    """A column for each input, in the order of `Design.inputs`."""
    if design.records:
        yield Column(RECORD, "Record", "1", "input", categories=design.records)
    for one in (*([design.scales] if design.scales else []), *design.axes):
        yield _input(one)


def _input(one: Axis) -> Column:
    label = one.places[0].label if one.path == SCALE else one.label
    return Column(one.path, label, one.shown, "input", categories=tuple(one.names), si=not one.categories)


def _intensity(design: Design) -> Iterator[Column]:
    if design.base["motion"]["kind"] == "none" or design.plan.driven:
        return
    yield Column("scale_factor", "Scale factor of the record", "1", "intensity", decimals=4)
    yield Column("pga_g", "PGA", "g", "intensity", decimals=4)
    yield Column("sa_t1_g", f"Sa(T1, {IM_DAMPING:.0%})", "g", "intensity", decimals=4)
    yield Column("t1_s", "T1", "s", "intensity", decimals=3)


def _outcome() -> Iterator[Column]:
    yield Column("status", "Status", "1", "outcome", categories=STATUSES)
    yield Column("trip_station", "Station that tripped", "1", "outcome", decimals=0)
    yield Column("trip_limit", "Limit that tripped", "1", "outcome", categories=tuple(LIMITS))
    yield Column("trip_time_s", "Time of the trip", "s", "outcome", decimals=3)
    yield Column("simulated_s", "Simulated time", "s", "outcome", decimals=2)
    yield Column("elapsed_s", "Computing time", "s", "outcome", decimals=4)


def _measures(design: Design) -> Iterator[Column]:
    names, floors = _largest(design)
    test = design.plan.test
    for number, name in enumerate(names, start=1):
        for station in of(StationMeasure, test):
            yield _measure(station, number, name)
    for floor in of(FloorMeasure, test):
        for number in range(1, floors + 1):
            yield _measure(floor, number, f"Floor {number}")
    for whole in of(RunMeasure, test):
        yield _measure(whole, None, "")


def _measure(one: Measure, number: int | None, name: str) -> Column:
    key = one.key if number is None else f"{one.key}.{number}"
    label = f"{one.label} ({name})" if name else one.label
    return Column(key, label, one.shown, "measure", one.scope, number, name, one.key, one.decimals)


def _largest(design: Design) -> tuple[list[str], int]:
    """Names of the stations, and number of floors, of the plan with the most of them: a choice of parts can change both."""
    names: list[str] = []
    floors = 0
    for data in _variants(design):
        plan = Plan.model_validate(data)
        if len(plan.stations) > len(names):
            names = [station.name for station in plan.stations]
        if not plan.driven:
            try:
                floors = max(floors, len(Model(plan).bare.floors))
            except PlanError:  # every point with this structure is invalid
                continue
    return names, floors


def _variants(design: Design) -> Iterator[dict[str, Any]]:
    yield design.base
    for one in design.axes:
        for level in range(len(one.categories)):
            yield with_values(design.base, one.values(level))
