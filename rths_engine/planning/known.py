"""How well a plan's numbers are known: the statements of a plan, and the tolerance that each statement gives a diagnosis."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, Literal

from rths_engine.foundation.errors import Issue

How = Literal["measured", "nominal", "guess"]
HOW: dict[str, str] = {"measured": "Measured", "nominal": "Nominal (drawing, data sheet)", "guess": "Guess"}
# chosen; see docs/decisions/0023
TOLERANCES: dict[str, dict[How, float]] = {  # relative standard deviations; of the clock: ms
    "mass": {"measured": 0.01, "nominal": 0.05, "guess": 0.3},
    "stiffness": {"measured": 0.03, "nominal": 0.1, "guess": 0.7},
    "damping": {"measured": 0.3, "nominal": 0.5, "guess": 1.0},
    "mode": {"measured": 0.1, "nominal": 0.2, "guess": 0.5},
    "actuator": {"measured": 0.05, "nominal": 0.15, "guess": 0.7},
    "specimen": {"measured": 0.05, "nominal": 0.15, "guess": 0.7},
    "clock": {"measured": 0.25, "nominal": 1.0, "guess": 5.0},
}
OF_STRUCTURE = ("mass", "stiffness", "damping")
OF_STATION = ("actuator", "specimen", "clock")


def structure_tolerance(known: Mapping[str, How], quantity: str) -> float | None:
    """The tolerance of the structure's `mass`, `stiffness`, `damping` or `mode`; None where the plan does not state it.

    `mode` is the damping of one mode relative to the damping of another. It follows the statement about the damping.
    """
    how = known.get(f"structure.{'damping' if quantity == 'mode' else quantity}")
    return None if how is None else TOLERANCES[quantity][how]


def station_tolerance(known: Mapping[str, How], station: int, section: str, field: str = "") -> float | None:
    """The tolerance of a number of the station with this index, counted from 0; None where the plan does not state it.

    `section` is `actuator`, `specimen` or `clock`. A statement about the field comes before the statement about its section.
    """
    path = f"stations.{station}.{section}"
    how = known.get(f"{path}.{field}", known.get(path))
    return None if how is None else TOLERANCES[section][how]


def issues_of_known(plan: Any) -> Iterator[Issue]:
    """The issues of statements about numbers that the plan does not have."""
    paths = set(_paths(plan))
    for path in plan.known:
        if path not in paths:
            fix = f"give one of: {', '.join(sorted(paths, key=len)[:6])}" if paths else "remove it"
            yield Issue("known", "is not the path of a number that a diagnosis of this plan refits", path, fix)


def _paths(plan: Any) -> Iterator[str]:
    if plan.test == "structure":
        yield from (f"structure.{name}" for name in OF_STRUCTURE)
    for index, station in enumerate(plan.stations):
        for section in OF_STATION:
            yield f"stations.{index}.{section}"
        for section in ("actuator", "specimen"):
            fields = type(getattr(station, section)).model_fields.items()
            yield from (f"stations.{index}.{section}.{name}" for name, field in fields if field.annotation is float)
