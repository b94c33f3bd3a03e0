"""Checks between the fields of a plan."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np

from rths_engine.foundation.errors import Issue, PlanError
from rths_engine.parts.specimens.commanded import Commanded
from rths_engine.parts.structures.modes import circular_frequencies
from rths_engine.planning.client import Client
from rths_engine.planning.connections import external, issues_of_connections
from rths_engine.planning.coupling_checks import issues_of_couplings
from rths_engine.planning.excitation import Drive
from rths_engine.planning.known import issues_of_known
from rths_engine.planning.model import Model
from rths_engine.planning.plan import Plan

# chosen; see docs/decisions/0023
LONGEST = 3600.0  # s, of a drive or a force
MOST_MOMENTS = 100_000  # samples of a drive that a check evaluates


def issues(model: Model) -> Iterator[Issue]:
    """All issues between the fields of the model's plan, according to its kind of test."""
    plan = model.plan
    lasting = list(_too_long(plan))
    yield from lasting or (_following(plan) if plan.driven else _computed(model))
    if plan.test != "client" and plan.client != Client():
        yield Issue("client", "is used only in tests with a client", fix="remove it, or choose the kind of test 'client'")
    yield from _names(plan)
    yield from _capacity(plan)
    yield from issues_of_known(plan)
    yield from _commands(plan)
    yield from _compensators(plan)
    yield from issues_of_connections(plan)
    yield from issues_of_couplings(plan)


def _too_long(plan: Plan) -> Iterator[Issue]:
    yield from too_long("drive.shape", plan.drive.shape)
    for index, force in enumerate(plan.forces):
        yield from too_long(f"forces.{index}.shape", force.shape)


def too_long(where: str, shape: Any) -> Iterator[Issue]:
    """The issue of a shape that lasts longer than the longest test."""
    if not shape.duration <= LONGEST:
        problem = f"lasts {shape.duration:.4g} s; the maximum is {LONGEST:g} s"
        yield Issue(where, problem, shape.kind, "reduce the number of cycles or raise the frequency")


def _following(plan: Plan) -> Iterator[Issue]:
    """Issues of a test without structure: its stations follow the drive or the client."""
    article = "an" if plan.test == "actuator" else "a"
    leader = "its client" if plan.test == "client" else "its drive"
    named = "a test with a client" if plan.test == "client" else f"a test of {article} {plan.test}"
    fix = f"choose none: {named} follows {leader}"
    if plan.structure.kind != "none":
        yield Issue("structure", "is not used in this kind of test", plan.structure.kind, fix)
    if plan.motion.kind != "none":
        yield Issue("motion", "is not used in this kind of test", plan.motion.kind, fix)
    if plan.forces:
        yield Issue("forces", "are not used in this kind of test", len(plan.forces), "remove them")
    if not plan.start.at_rest:
        yield Issue("start", "is not used in this kind of test", fix="leave it at rest")
    for name in ("structure_physics", "motion_physics"):
        if getattr(plan, name):
            yield Issue(name, "is not used in this kind of test", len(getattr(plan, name)), "remove it")
    yield from _unused(plan)
    yield from _led(plan) if plan.test == "client" else _driven(plan)


def _unused(plan: Plan) -> Iterator[Issue]:
    """Issues of fields of stations that this kind of test does not use."""
    for index, station in enumerate(plan.stations):
        for name, field in type(station).model_fields.items():
            extra: Any = field.json_schema_extra or {}
            given = getattr(station, name)
            if plan.test not in extra.get("tests", (plan.test,)) and given != field.default:
                yield Issue(f"stations.{index}.{name}", "is not used in this kind of test", given, "remove it")


def _driven(plan: Plan) -> Iterator[Issue]:
    if len(plan.stations) != 1:
        yield Issue("stations", "this kind of test has one station", len(plan.stations), "give exactly one station")
    if plan.drive.shape.kind == "still":
        yield Issue("drive.shape", "a test of one station needs a drive", "still", "choose the shape of its displacement")
    elif plan.stations:
        yield from _within_limits(plan)


def _led(plan: Plan) -> Iterator[Issue]:
    if not plan.stations:
        fix = "give one station for each basic degree of freedom of the client"
        yield Issue("stations", "this kind of test has at least one station", 0, fix)
    if plan.drive.shape.kind != "still":
        yield Issue("drive", "is used only in tests of a specimen or an actuator", plan.drive.shape.kind, "leave it at rest")
    for index, connection in external(plan).items():
        problem = "is an external rig, but a client moves emulated stations only"
        yield Issue(f"stations.{index}.connection", problem, connection.kind, "choose an emulated station, or a hybrid test")


def _within_limits(plan: Plan) -> Iterator[Issue]:
    """Issues of a drive that would trip the limits. The whole drive is known, so they are reported before the start."""
    reached, fastest = peaks(plan.drive, plan.duration or plan.drive.shape.duration, plan.controller_rate)
    limits = plan.stations[0].limits
    if reached > limits.displacement:
        problem = f"reaches {reached * 1e3:.4g} mm, beyond the station's limit of {limits.displacement * 1e3:g} mm"
        yield Issue("drive.amplitude", problem, plan.drive.amplitude, "lower the amplitude or raise the limit")
    if fastest > limits.velocity:
        problem = f"reaches {fastest * 1e3:.4g} mm/s, beyond the station's limit of {limits.velocity * 1e3:g} mm/s"
        yield Issue("drive.shape", problem, plan.drive.shape.kind, "lower the velocity or the amplitude")


def peaks(drive: Drive, duration: float, rate: float) -> tuple[float, float]:
    """Largest displacement (m) and velocity (m/s) of the command over the controller steps, at most MOST_MOMENTS of them."""
    steps = math.ceil(duration * rate)
    step = np.arange(0, steps + 1, max(1, steps // MOST_MOMENTS))
    now, before = np.split(drive.sample(np.concatenate([step, np.maximum(step - 1, 0)]) / rate), 2)
    before[0] = 0.0  # every test starts from rest
    return float(np.max(np.abs(now))), float(np.max(np.abs(now - before))) * rate


def _computed(model: Model) -> Iterator[Issue]:
    plan = model.plan
    if plan.structure.kind == "none":
        yield Issue("structure", "this kind of test computes a structure", "none", "choose a structure")
        return
    beyond = list(_beyond(model))
    if beyond:  # the structure cannot be assembled with these effects
        yield from beyond
        return
    if plan.drive.shape.kind != "still":
        yield Issue("drive", "is used only in tests of a specimen or an actuator", plan.drive.shape.kind, "leave it at rest")
    if plan.test == "structure" and plan.stations:
        yield Issue(
            "stations", "a test of a structure alone has no stations", len(plan.stations), "remove them or choose a hybrid test"
        )
    if plan.test == "hybrid" and not plan.start.at_rest:
        yield Issue("start", "a hybrid test starts from rest", fix="choose a test of the structure alone, or start at rest")
    moved = plan.motion.kind != "none" or plan.forces
    if not moved and plan.duration is None:
        yield Issue("duration", "is not defined without ground motion or forces", None, "give a duration")
    dt, n, rate = plan.integrator.dt, plan.integrator.substeps, plan.controller_rate
    if not math.isclose(dt * rate, n, rel_tol=1e-9):
        fix = f"with {n} substeps at {rate:g} Hz the step is {n / rate:.9g} s"
        yield Issue("integrator.dt", f"is {dt * rate:.6g} controller steps, but a step has {n} substeps", dt, fix)
    yield from _stable(model)
    yield from _places(model)


def _beyond(model: Model) -> Iterator[Issue]:
    floors = len(model.bare.floors)
    for index, effect in enumerate(model.plan.structure_physics):
        storey = getattr(effect, "storey", 1)
        if storey > floors:
            where = f"structure_physics.{index}.storey"
            yield Issue(where, f"the structure has {floors} storeys", storey, f"give a storey from 1 to {floors}")


def _stable(model: Model) -> Iterator[Issue]:
    plan = model.plan
    bound = plan.integrator.stable_up_to
    if math.isinf(bound):
        return
    built, title = model.built, plan.integrator.title
    massless = int(np.sum(~built.mass.any(axis=0)))
    if massless:
        problem = f"has {massless} degrees of freedom without mass, which {title.lower()} cannot integrate"
        yield Issue("integrator.kind", problem, plan.integrator.kind, "give them mass or choose CR or KR-α")
        return
    highest = float(circular_frequencies(built.mass, built.stiffness)[-1])
    if highest * plan.integrator.dt > bound:
        problem = (
            f"is {highest * plan.integrator.dt:.4g} over the highest circular frequency; {title.lower()} is unstable above 2"
        )
        fix = f"give at most {bound / highest:.3g} s, or choose CR or KR-α"
        yield Issue("integrator.dt", problem, plan.integrator.dt, fix)


def _places(model: Model) -> Iterator[Issue]:
    plan, built = model.plan, model.built
    floors, storeys = len(built.floors), len(built.drifts)
    for index, station in enumerate(plan.stations):
        if station.storey > storeys:
            where = f"stations.{index}.storey"
            yield Issue(where, f"the structure has {storeys} storeys", station.storey, f"give a storey from 1 to {storeys}")
    for index, force in enumerate(plan.forces):
        if force.floor > floors:
            yield Issue(
                f"forces.{index}.floor", f"the structure has {floors} floors", force.floor, f"give a floor from 1 to {floors}"
            )
    for name in ("displacement", "velocity"):
        given = len(getattr(plan.start, name))
        if given not in (0, floors):
            yield Issue(
                f"start.{name}", f"has {given} numbers for {floors} floors", None, f"give {floors} numbers, or none for rest"
            )


def _names(plan: Plan) -> Iterator[Issue]:
    names = [station.name for station in plan.stations]
    for index, name in enumerate(names):
        if name in names[:index]:
            yield Issue(
                f"stations.{index}.name", "is already the name of another station", name, "give each station its own name"
            )


def _capacity(plan: Plan) -> Iterator[Issue]:
    """Issues of limits that allow a command that the actuator cannot follow."""
    for index, station in enumerate(plan.stations):
        limit, capacity = station.limits.velocity, station.actuator.velocity_limit
        if limit > capacity:
            problem = f"allows {limit * 1e3:g} mm/s, more than the actuator's limit of {capacity * 1e3:g} mm/s"
            fix = "lower the limit to the actuator's capacity or choose a faster actuator"
            yield Issue(f"stations.{index}.limits.velocity", problem, limit, fix)


def _compensators(plan: Plan) -> Iterator[Issue]:
    """Issues of compensators whose gains have no solution at the controller rate of the plan."""
    for index, station in enumerate(plan.stations):
        try:
            station.compensator.build(plan.substep)
        except PlanError as error:
            yield from (replace(issue, where=f"stations.{index}.{issue.where}") for issue in error.issues)


def _commands(plan: Plan) -> Iterator[Issue]:
    """Issues of specimens that follow a current which no controller commands."""
    for index, station in enumerate(plan.stations):
        if isinstance(station.specimen, Commanded) and station.controller.kind == "none":
            problem = f"is none, but the specimen '{station.specimen.title}' follows a current"
            yield Issue(f"stations.{index}.controller", problem, "none", "choose a controller, for example a constant current")
