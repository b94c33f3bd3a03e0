"""The constant data of the compiled loop, from a plan: parts of the stations, matrices, excitation and limits."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rths_engine.foundation.arrays import Array
from rths_engine.parts import actuators, compensators, controllers, specimens
from rths_engine.parts.physics.effect import STOREY
from rths_engine.parts.physics.structure.storey import OfStorey, drift, stiffness
from rths_engine.planning.model import Model
from rths_engine.planning.plan import Plan
from rths_engine.planning.safety import LIMITS
from rths_engine.results.channels import recorded
from rths_engine.running import starting
from rths_engine.running.condensed_frame import condensed_equations
from rths_engine.running.data import MEMORY, LeftOut, Setup, State
from rths_engine.running.dispatch import effects as effects_of
from rths_engine.running.dispatch import stacked
from rths_engine.running.equations import whole
from rths_engine.running.restoring import rows


def setup(
    model: Model, inputs: Array, drive: Array, noise: Array, initial: tuple[Sequence[float], Sequence[float]] | None = None
) -> tuple[Setup, State]:
    """The constant data of a run, and its start state: as planned, or from the displacements (m) and velocities `initial`.

    inputs (steps + 1, I), drive (steps + 1, stations), noise (substeps, stations, 2).
    """
    plan, built, scheme = model.plan, model.built, model.scheme
    solved = condensed_equations(model) or whole(model)
    codes, parameters, parts = _built(plan)
    stations = len(plan.stations)
    held = Setup(
        n=plan.substeps,
        dt_step=plan.step,
        dt=plan.substep,
        factor=solved.factor,
        held=rows(np.zeros_like(solved.damping) if solved.held is None else solved.held),
        weight=scheme.weight,
        shift=scheme.shift,
        damping=rows(solved.damping),
        elastic=rows(solved.elastic),
        members=solved.members,
        points=solved.points,
        loads=solved.loads,
        inputs=inputs,
        floors=np.searchsorted(solved.kept, np.array(built.floors, dtype=np.int64)),
        drifts=solved.drifts,
        drive=drive,
        dampers=np.array([float(station.dampers) for station in plan.stations]),
        codes=codes,
        parameters=parameters,
        limits=np.array([_limits(station) for station in plan.stations]).reshape(stations, len(LIMITS)),
        noise=noise,
        temperatures=np.array([station.temperature for station in plan.stations]),
        columns=_columns(plan, len(model.loads) + len(built.floors)),
        kept=solved.kept,
    )
    x, v, carry = starting.state(model, inputs[0] @ model.loads)
    if initial:
        x[:], v[:] = initial
    x, v, carry, points = solved.start(x, v, carry)
    plastic = np.zeros((len(solved.members.dofs), 3))
    return held, State(x, v, carry, plastic, points, parts, np.zeros((stations, MEMORY)))


_SLOTS: tuple[Sequence[Any], ...] = (compensators.KINDS, actuators.KINDS, specimens.KINDS, controllers.KINDS)  # as Station.rig


def _built(plan: Plan) -> tuple[NDArray[np.int64], Array, Array]:
    """Codes (stations, 4), parameters and states (4, stations, widest) of the stations' parts."""
    stations = len(plan.stations)
    codes = np.zeros((stations, len(_SLOTS)), dtype=np.int64)
    built: list[list[tuple[Array, Array]]] = [[] for _ in _SLOTS]
    for slot, kinds in enumerate(_SLOTS):
        for j, station in enumerate(plan.stations):
            part = station.rig[slot]
            codes[j, slot] = kinds.index(type(part))
            built[slot].append(part.build(plan.substep))
    return codes, _padded(built, 0), _padded(built, 1)


def _columns(plan: Plan, first: int) -> NDArray[np.int64]:
    """The first and the last column + 1 of each station in the loop's rows; the columns of the stations begin at `first`."""
    ends = first + np.cumsum([0, *(len(recorded(station)) for station in plan.stations)])
    return np.column_stack([ends[:-1], ends[1:]]).astype(np.int64)


def left_out(model: Model, kept: NDArray[np.int64]) -> LeftOut | None:
    """The left-out effects of the plan in the form of the loop, whose degrees of freedom are `kept`; None without effects."""
    plan = model.plan
    return effects_in(model, kept) if _against(plan) or any(station.physics for station in plan.stations) else None


def effects_in(model: Model, kept: NDArray[np.int64]) -> LeftOut:
    """The left-out effects of the plan in the form of the loop, also where it has none."""
    plan, built = model.plan, model.built
    against = _against(plan)
    drifts = [drift(built, effect.storey) for effect in against]
    return LeftOut(
        stations=stacked([effects_of(station.physics, plan.substep) for station in plan.stations]),
        storeys=stacked([effects_of([effect], plan.step) for effect in against]),
        drifts=np.ascontiguousarray(np.array(drifts).reshape(len(drifts), len(built.mass))[:, kept]),
        stiffness=np.array([stiffness(built, row) for row in drifts]),
    )


def _against(plan: Plan) -> list[OfStorey]:
    return [effect for effect in plan.structure_physics if isinstance(effect, OfStorey) and effect.hook == STOREY]


def _padded(built: list[list[tuple[Array, Array]]], which: int) -> Array:
    vectors = [[pair[which] for pair in slot] for slot in built]
    widest = max((len(vector) for slot in vectors for vector in slot), default=1)
    table = np.zeros((len(vectors), len(vectors[0]), widest))
    for slot, row in enumerate(vectors):
        for j, vector in enumerate(row):
            table[slot, j, : len(vector)] = vector
    return table


def _limits(station: Any) -> tuple[float, ...]:
    return tuple(getattr(station.limits, name) or np.inf for name in LIMITS)
