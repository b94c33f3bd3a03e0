"""Checks of couplings: stations that exist, each on one specimen only, which gives out no energy, and its mass."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from rths_engine.foundation.errors import Issue
from rths_engine.parts.connections.connection import External
from rths_engine.parts.specimens.commanded import Commanded
from rths_engine.planning.coupling import EQUAL, Attached, Coupling, LoadingBeam, Weighted
from rths_engine.planning.plan import Plan


def issues_of_couplings(plan: Plan) -> Iterator[Issue]:
    """All issues of the couplings of a plan."""
    if not plan.couplings:
        return
    if plan.test != "hybrid":
        yield Issue("couplings", "are used only in hybrid tests", len(plan.couplings), "remove them, or choose a hybrid test")
        return
    for index, station in enumerate(plan.stations):
        if isinstance(station.connection, External):
            problem = "is an external rig; a test in which stations share a specimen runs on models"
            yield Issue(f"stations.{index}.connection", problem, station.connection.kind, "emulate it, or remove the couplings")
    owners: dict[int, str] = {}
    for index, coupling in enumerate(plan.couplings):
        where = f"couplings.{index}"
        absent = [number for number in coupling.stations if number > len(plan.stations)]
        if absent:
            fix = f"give numbers from 1 to {len(plan.stations)}, in the order of the stations"
            yield Issue(f"{where}.stations", "is not the number of a station", absent[0], fix)
            continue
        for number in coupling.stations:
            if number in owners:
                problem = f"station {number} is already on the specimen '{owners[number]}'"
                yield Issue(f"{where}.stations", problem, number, "give each station to one coupling, once")
            else:
                yield from _of_station(plan, number)
            owners[number] = coupling.name
        yield from _of_laws(coupling, where)
        wrong = [*_of_energy(coupling, where)]
        yield from wrong or _of_mass(plan, coupling, where)


def not_diagnosed(plan: Plan) -> Issue | None:
    """Why recordings of a plan cannot be diagnosed; None where its stations share no specimen."""
    if not plan.couplings:
        return None
    names = ", ".join(coupling.name for coupling in plan.couplings)
    problem = "has stations that share a specimen; a diagnosis replays each station with a specimen of its own"
    return Issue("plan", problem, names, "compare the recording with a run of this plan instead")


def _of_station(plan: Plan, number: int) -> Iterator[Issue]:
    station, where = plan.stations[number - 1], f"stations.{number - 1}"
    if station.specimen.kind != "none":
        problem = "shares a specimen, so it has none of its own"
        yield Issue(f"{where}.specimen", problem, station.specimen.kind, "choose none; describe the specimen in the coupling")
    if station.specimen_physics:
        problem = "acts on the station's own specimen, and the station shares one"
        yield Issue(f"{where}.specimen_physics", problem, len(station.specimen_physics), "remove it")
    if station.dampers != 1:
        yield Issue(f"{where}.dampers", "a station that shares a specimen represents itself only", station.dampers, "give 1")


def _of_energy(coupling: Coupling, where: str) -> Iterator[Issue]:
    """Issues of a linear specimen that would give out energy, or whose matrices do not fit its stations."""
    if isinstance(coupling, LoadingBeam):
        most = (coupling.stiffness * coupling.rotational_stiffness) ** 0.5
        if abs(coupling.cross_stiffness) > most * (1 + EQUAL):
            problem = f"the specimen would give out energy: |k_c| is above √(k k_θ) = {most:g} N"
            yield Issue(f"{where}.cross_stiffness", problem, coupling.cross_stiffness, "lower it, or raise k or k_θ")
        return
    for name in ("stiffness", "damping", "mass"):
        yield from _of_rows(getattr(coupling, name), len(coupling.stations), f"{where}.{name}")


def _of_rows(rows: Sequence[Sequence[float]], count: int, where: str) -> Iterator[Issue]:
    if not rows:
        return
    if len(rows) != count or any(len(row) != count for row in rows):
        yield Issue(where, f"needs {count} rows of {count} numbers, one for each station")
        return
    matrix = np.array(rows)
    least, largest = float(np.linalg.eigvalsh(matrix)[0]), np.abs(matrix).max()
    if np.abs(matrix - matrix.T).max() > EQUAL * largest:
        yield Issue(where, "is not symmetric: give the same number on both sides of the diagonal")
    elif least < -EQUAL * largest:
        yield Issue(where, f"has the negative eigenvalue {least:.4g} (SI): the specimen would give out energy")


def _of_laws(coupling: Coupling, where: str) -> Iterator[Issue]:
    count = len(coupling.stations)
    specimens: Sequence[Attached | Weighted] = coupling.specimens
    for index, one in enumerate(specimens):
        kind = one.specimen.kind
        if isinstance(one, Weighted) and len(one.weights) != count:
            problem = f"needs {count} weights, one for each station"
            yield Issue(f"{where}.specimens.{index}.weights", problem, len(one.weights))
        if isinstance(one.specimen, Commanded):
            problem = f"'{one.specimen.title}' follows a current, which a shared specimen does not get"
            yield Issue(f"{where}.specimens.{index}.specimen", problem, kind, "choose a specimen without a command")


def _of_mass(plan: Plan, coupling: Coupling, where: str) -> Iterator[Issue]:
    """The issue of a specimen that is too heavy for its actuators, which feel its inertia force one controller step late."""
    moving = np.array([getattr(plan.stations[number - 1].actuator, "mass", np.inf) for number in coupling.stations])
    with np.errstate(over="ignore"):
        shares = coupling.matrices().mass / moving[:, None]
    ratio = float(np.max(np.abs(np.linalg.eigvals(shares)))) if np.isfinite(shares).all() else np.inf
    if ratio >= 1:
        problem = f"is {ratio:.3g} times the moving mass of the actuators, which feel its inertia a controller step late"
        fix = "add the mass to the moving mass of the actuators instead: above 1 the rig is unstable"
        yield Issue(f"{where}.mass", problem, None, fix)
