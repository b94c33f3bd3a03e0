"""The safety limits of a plan against the capacities of a rig: a limit above a capacity would trip too late."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from app.models import Rig
from app.rigs.schemas import RigKind
from rths_engine.foundation import units
from rths_engine.foundation.errors import Issue
from rths_engine.planning.connections import external, too_fast
from rths_engine.planning.plan import Plan, Station

CAPACITIES = {"displacement": ("stroke", "mm"), "velocity": ("velocity", "mm/s"), "force": ("force", "kN")}
"""Safety limit of a station -> the capacity of the actuator that bounds it, and the unit shown."""


def exceeded(plan: Plan, rig: Rig) -> list[Issue]:
    """What of a plan a rig refuses: machines on an emulated rig, a physical one faster than in real time, too high limits."""
    if rig.kind != RigKind.PHYSICAL and (machines := list(_machines(plan, rig))):
        return machines
    fast = too_fast(plan, f"rig {rig.name}") if rig.kind == RigKind.PHYSICAL and plan.stations else None
    return [*([fast] if fast else []), *_beyond(plan, rig)]


def _beyond(plan: Plan, rig: Rig) -> list[Issue]:
    """What of a plan exceeds the capacities of a rig."""
    if not rig.actuators:
        return []
    if len(plan.stations) > len(rig.actuators):
        most = f"rig {rig.name} has {_counted(len(rig.actuators), 'actuator')}"
        fix = "use fewer stations, or choose another rig"
        return [Issue("stations", f"has {_counted(len(plan.stations), 'station')}, but {most}", None, fix)]
    return [
        issue
        for index, (station, actuator) in enumerate(zip(plan.stations, rig.actuators, strict=False))
        for issue in _of_station(index, station, actuator, rig)
    ]


def _machines(plan: Plan, rig: Rig) -> Iterator[Issue]:
    """Issues of stations that drive a machine: only a physical rig executes one test at a time within known capacities."""
    for index, connection in external(plan).items():
        if connection.physical:
            problem = f"drives the {connection.peer}, which can be a machine, but rig {rig.name} is emulated"
            fix = "add a physical rig with its capacities under Settings, and choose it"
            yield Issue(f"stations.{index}.connection", problem, None, fix)


def _of_station(index: int, station: Station, actuator: Mapping[str, Any], rig: Rig) -> Iterator[Issue]:
    for limit, (capacity, unit) in CAPACITIES.items():
        planned, bound = getattr(station.limits, limit), actuator.get(capacity)
        if bound is None or planned <= bound:
            continue
        given, most = (f"{units.from_si(value, unit):.4g} {units.pretty(unit)}" for value in (planned, bound))
        name = f" ({actuator['name']})" if actuator.get("name") else ""
        problem = f"exceeds the {capacity} of {most} of actuator {index + 1}{name} of rig {rig.name}"
        yield Issue(f"stations.{index}.limits.{limit}", problem, given, f"lower the limit to {most}, or choose another rig")


def _counted(number: int, noun: str) -> str:
    return f"{number} {noun}{'' if number == 1 else 's'}"
