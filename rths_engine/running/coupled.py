"""Controller steps of a plan in which stations share a specimen: all actuators move, then the specimen resists all of them.

f = M a + C v + K x + sum of w_i f_i(w_i x) between the strokes x of a coupling (`planning.coupling`), v = (x[q] - x[q-1]) / dt
and a = (x[q] - 2 x[q-1] + x[q-2]) / dt^2. Each actuator feels its force in the next controller step, as it does with a specimen
of its own. Stations outside couplings take the same pieces in the same order as in a plan without couplings.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.kernel import entry, piece
from rths_engine.parts import specimens
from rths_engine.planning.plan import Plan
from rths_engine.running.controller_step import commanded, find_ends, record_structure, settle, trip
from rths_engine.running.data import F_TRUE, V_TRUE, X_END, X_TRUE, LeftOut, Record, Setup, State
from rths_engine.running.dispatch import resist
from rths_engine.running.integration import integrate
from rths_engine.running.pacing import STOPPED, Pacing, await_step, end_step, start
from rths_engine.running.station import begin, finish, move, react, read

X_CMD, X_COMP, CURRENT, X, FORCE = range(5)  # of a station in the present controller step


class Coupled(NamedTuple):
    """The specimens that stations share, and what they remember. C couplings of up to A stations, L laws, S stations."""

    alone: Any  # whether a station has a specimen of its own (S)
    counts: Any  # stations of each coupling (C)
    stations: Any  # their places, from 0 (C, A)
    mass: Any  # (C, A, A)
    damping: Any  # (C, A, A)
    stiffness: Any  # (C, A, A)
    owners: Any  # coupling of each law (L)
    weights: Any  # of the strokes in its displacement (L, A)
    codes: Any  # (L)
    parameters: Any  # (L, widest)
    states: Any  # changes: (L, widest)
    past: Any  # changes: strokes one and two controller steps before (C, 2, A)
    now: Any  # changes: X_CMD to FORCE of each station (S, 5)


def coupled(plan: Plan) -> Coupled | None:
    """The shared specimens of a plan in the form of the loop; None for a plan without couplings."""
    if not plan.couplings:
        return None
    most = max(len(one.stations) for one in plan.couplings)
    count, stations = len(plan.couplings), len(plan.stations)
    places = np.zeros((count, most), dtype=np.int64)
    matrices = np.zeros((3, count, most, most))
    laws = [(c, law) for c, one in enumerate(plan.couplings) for law in one.laws()]
    weights = np.zeros((len(laws), most))
    alone = np.ones(stations, dtype=np.bool_)
    for c, one in enumerate(plan.couplings):
        n = len(one.stations)
        places[c, :n] = np.array(one.stations) - 1
        matrices[:, c, :n, :n] = one.matrices()
        alone[places[c, :n]] = False
    for k, (_, law) in enumerate(laws):
        weights[k, : len(law.weights)] = law.weights
    built = [law.specimen.build(plan.substep) for _, law in laws]
    widest = max((len(vector) for pair in built for vector in pair), default=1)
    tables = np.zeros((2, len(laws), widest))
    for k, pair in enumerate(built):
        for table, vector in zip(tables, pair, strict=True):
            table[k, : len(vector)] = vector
    return Coupled(
        alone=alone,
        counts=np.array([len(one.stations) for one in plan.couplings], dtype=np.int64),
        stations=places,
        mass=matrices[0],
        damping=matrices[1],
        stiffness=matrices[2],
        owners=np.array([c for c, _ in laws], dtype=np.int64),
        weights=weights,
        codes=np.array([specimens.KINDS.index(type(law.specimen)) for _, law in laws], dtype=np.int64),
        parameters=tables[0],
        states=tables[1],
        past=np.zeros((count, 2, most)),
        now=np.zeros((stations, 5)),
    )


@piece
def resist_together(c: int, setup: Setup, state: State, shared: Coupled) -> None:
    """The forces of coupling c at the strokes of its actuators, which have all moved; its memory becomes that of this step."""
    dt, n, places, now, past = setup.dt, shared.counts[c], shared.stations[c], shared.now, shared.past[c]
    for a in range(n):
        force = 0.0
        for b in range(n):
            x = now[places[b], X]
            v = (x - past[0, b]) / dt
            acceleration = (v - (past[0, b] - past[1, b]) / dt) / dt
            force += shared.stiffness[c, a, b] * x + shared.damping[c, a, b] * v + shared.mass[c, a, b] * acceleration
        now[places[a], FORCE] = force
    for k in range(shared.owners.size):
        if shared.owners[k] == c:
            stroke = 0.0
            for b in range(n):
                stroke += shared.weights[k, b] * now[places[b], X]
            force = resist(shared.codes[k], shared.parameters[k], shared.states[k], stroke, dt)
            for a in range(n):
                now[places[a], FORCE] += shared.weights[k, a] * force
    for a in range(n):
        memory, x = state.memory[places[a]], now[places[a], X]
        past[1, a], past[0, a] = past[0, a], x
        memory[V_TRUE] = (x - memory[X_TRUE]) / dt
        memory[X_TRUE], memory[X_END], memory[F_TRUE] = x, x, now[places[a], FORCE]


@piece
def step_together(
    done: int, share: float, setup: Setup, state: State, left_out: LeftOut, shared: Coupled, ends: Array, record: Record
) -> int:
    """Controller step `done`, counted from 0, of all stations, at a share of their motion to its ends, as `step_stations`.

    Returns 0 or the position plus 1 of the exceeded limit.
    """
    time, row, now = (done + 1) * setup.dt, record.signals[done], shared.now
    for j in range(setup.dampers.size):
        now[j, X_CMD] = commanded(ends, j, share)
        broken, value, x_comp, current = begin(j, setup, state, now[j, X_CMD])
        if broken > 0:
            trip(j, broken, value, done, setup, record)
            return broken
        now[j, X_COMP], now[j, CURRENT] = x_comp, current
    for j in range(setup.dampers.size):
        now[j, X] = move(j, setup, state, left_out, now[j, X_COMP], time)
        if shared.alone[j]:
            now[j, FORCE] = react(j, setup, state, left_out, now[j, X], now[j, CURRENT], time)
    for c in range(shared.counts.size):
        resist_together(c, setup, state, shared)
    for j in range(setup.dampers.size):
        x_meas, f_meas = read(j, setup, state, left_out, now[j, X], now[j, FORCE], setup.noise[done, j], time)
        x_cmd, x_comp, current = now[j, X_CMD], now[j, X_COMP], now[j, CURRENT]
        broken, value = finish(j, setup, state, x_cmd, x_comp, current, x_meas, f_meas, row)
        if broken > 0:
            trip(j, broken, value, done, setup, record)
            return broken
    return 0


@entry
def advance_coupled(
    first: int, last: int, setup: Setup, state: State, left_out: LeftOut, shared: Coupled, record: Record, pacing: Pacing
) -> tuple[int, int]:
    """Integration steps first to last - 1, as `loop.advance`, with stations that share specimens."""
    n, stations, paced = setup.n, setup.dampers.size, pacing.period > 0.0
    residual, work, x_next = np.empty(state.x.size), np.empty(state.x.size), np.empty(state.x.size)
    ends = np.empty((stations, 2))
    if paced:
        start(pacing)
    for i in range(first, last):
        for q in range(1, n + 1):
            done = i * n + q - 1
            if paced:
                await_step(done, pacing)
            if q == 1:
                integrate(i, setup, state, left_out, residual, work, x_next)
                find_ends(i, setup, state, x_next, ends)
            record_structure(i, q / n, setup, state, x_next, record.signals[done])
            broken = step_together(done, q / n, setup, state, left_out, shared, ends, record)
            if broken > 0:
                return broken, done
            if q == n:
                settle(i, setup, state, x_next, record)
            if paced and end_step(done, pacing):
                return STOPPED, done + 1
    return 0, last * n
