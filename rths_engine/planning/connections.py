"""Stations of a plan that are external rigs: their checks, and the plan with every station emulated by its models."""

from __future__ import annotations

from collections.abc import Iterator

from rths_engine.foundation.errors import Issue
from rths_engine.parts.connections.connection import External
from rths_engine.parts.connections.emulated import Emulated
from rths_engine.planning.model import Model
from rths_engine.planning.plan import Plan, RealTime, Station


def external(plan: Plan) -> dict[int, External]:
    """The connections of the stations that are external rigs, by the index of the station."""
    return {index: one.connection for index, one in enumerate(plan.stations) if isinstance(one.connection, External)}


def physical(plan: Plan) -> bool:
    """Whether a station of the plan can be a machine."""
    return any(station.connection.physical for station in plan.stations)


def modelled(model: Model) -> Model:
    """The model of the plan with every station emulated: what predicts a test, and never moves a rig."""
    return model.changed(stations=emulated(model.plan).stations) if external(model.plan) else model


def emulated(plan: Plan) -> Plan:
    """The plan with every station emulated."""
    if not external(plan):
        return plan
    stations = tuple(one.model_copy(update={"connection": Emulated()}) for one in plan.stations)
    return plan.model_copy(update={"stations": stations})


def sentences(plan: Plan) -> list[str]:
    """For each external station, what it is."""
    return [
        f"Station {index + 1} ({plan.stations[index].name}) is external: {connection.peer}."
        for index, connection in external(plan).items()
    ]


def predicted(plan: Plan) -> list[str]:
    """A note for predictions of a plan with external stations."""
    found = external(plan)
    if not found:
        return []
    names = ", ".join(f"{index + 1} ({plan.stations[index].name})" for index in found)
    which = f"Station {names} is an external rig" if len(found) == 1 else f"Stations {names} are external rigs"
    return [f"{which}. This prediction uses the models of the plan; no rig was moved or asked."]


def issues_of_connections(plan: Plan) -> Iterator[Issue]:
    """The issues of external stations."""
    found = external(plan)
    peers: dict[str, int] = {}
    for index, connection in found.items():
        where = f"stations.{index}.connection"
        yield from _of_station(where, plan.stations[index], connection)
        if plan.test == "client":
            fix = "emulate the station by its models"
            yield Issue(where, "is an external rig, which a test with a client cannot drive", connection.kind, fix)
        first = peers.setdefault(connection.peer, index) if connection.physical else index
        if first != index:
            problem = f"is the {connection.peer}, which is also the rig of station {first + 1}"
            yield Issue(where, problem, connection.kind, "give each station its own rig")
    if physical(plan):
        yield from _of_pace(plan, next(index for index, connection in found.items() if connection.physical))


def too_fast(plan: Plan, rig: str) -> Issue | None:
    """The issue of a plan that moves `rig` faster than its limits, which count in time of the test."""
    if not isinstance(plan.pace, RealTime) or plan.pace.factor <= 1:
        return None
    problem = f"moves {rig} faster than the velocity limit, which counts in time of the test: the most is 1, real time"
    return Issue("pace.factor", problem, plan.pace.factor, "lower the speed factor to 1; below 1 is slower")


def _of_pace(plan: Plan, first: int) -> Iterator[Issue]:
    """The issues of the pace of a plan whose station `first` (from 0) can be a machine."""
    rig = f"the rig of station {first + 1} ({plan.stations[first].name})"
    if plan.pace.kind != "real_time":
        fix = "choose real time; a factor below 1 is slower"
        yield Issue("pace", f"has no clock that {rig} could follow", plan.pace.kind, fix)
    elif issue := too_fast(plan, rig):
        yield issue


def _of_station(where: str, station: Station, connection: External) -> Iterator[Issue]:
    commanded, given = station.controller.kind != "none", connection.gives.force is not None
    if commanded and given and not connection.takes_current:
        fix = "name where the rig takes the current" if "current" in type(connection).model_fields else "choose no controller"
        yield Issue(where, "has no place for the current that the controller commands", connection.kind, fix)
