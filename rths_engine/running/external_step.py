"""A controller step whose stations may be external rigs: the compiled pieces between which the adapters exchange values.

For integration step i: `begin_step`; for q = 1 to n `begin_stations`, then the commands go out and the readings come in, then
`finish_stations`; at last `end_step`. All stations begin before any command is sent, so that a limit of one station stops all.
"""

from __future__ import annotations

import copy
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from rths_engine.foundation.kernel import entry
from rths_engine.running.controller_step import commanded, find_ends, record_structure, settle, trip
from rths_engine.running.data import F_TRUE, V_TRUE, X_END, X_TRUE, LeftOut, Record, Setup, State
from rths_engine.running.integration import integrate
from rths_engine.running.station import DISPLACEMENT, begin, finish, move, react, read

# what of a station is external
NOTHING, ALL, ACTUATOR, SPECIMEN = range(4)
X_CMD, X_COMP, CURRENT, SENT = range(4)  # columns of Work.begun


class Work(NamedTuple):
    """Memory of a step. S stations."""

    residual: Any  # (DOF)
    solved: Any  # (DOF)
    x_next: Any  # (DOF)
    ends: Any  # commands at both ends of the integration step (S, 2)
    begun: Any  # command, compensated command, current, and the displacement that goes to the rig (S, 4)
    readings: Any  # displacement and force of the external rigs, m and N (S, 2)


def work(degrees: int, stations: int) -> Work:
    """The memory of a step for this many degrees of freedom and stations."""
    residual, solved, x_next = (np.empty(degrees) for _ in range(3))
    return Work(residual, solved, x_next, np.empty((stations, 2)), np.zeros((stations, 4)), np.zeros((stations, 2)))


@entry
def begin_step(i: int, setup: Setup, state: State, left_out: LeftOut, work: Work) -> None:
    """Integrate step i and find the commands of the stations at its ends."""
    integrate(i, setup, state, left_out, work.residual, work.solved, work.x_next)
    find_ends(i, setup, state, work.x_next, work.ends)


@entry
def begin_stations(
    done: int, roles: NDArray[np.int64], setup: Setup, state: State, left_out: LeftOut, work: Work, record: Record
) -> int:
    """Begin controller step `done`, from 0, of all stations. Returns 0 or the position plus 1 of the exceeded limit.

    What goes to a rig is finite and within the displacement limit: the compensated command, or for an external specimen the
    displacement of its emulated actuator.
    """
    i, q = done // setup.n, done % setup.n + 1
    share, time = q / setup.n, (done + 1) * setup.dt
    record_structure(i, share, setup, state, work.x_next, record.signals[done])
    for j in range(setup.dampers.size):
        x_cmd = commanded(work.ends, j, share)
        broken, value, x_comp, current = begin(j, setup, state, x_cmd)
        if broken > 0:
            trip(j, broken, value, done, setup, record)
            return broken
        sent = x_comp
        if roles[j] == SPECIMEN:
            sent = move(j, setup, state, left_out, x_comp, time)
        if roles[j] != NOTHING and not abs(sent) <= setup.limits[j, DISPLACEMENT - 1]:
            trip(j, DISPLACEMENT, sent, done, setup, record)
            return DISPLACEMENT
        work.begun[j, X_CMD], work.begun[j, X_COMP], work.begun[j, CURRENT], work.begun[j, SENT] = x_cmd, x_comp, current, sent
    return 0


@entry
def finish_stations(
    done: int, roles: NDArray[np.int64], setup: Setup, state: State, left_out: LeftOut, work: Work, record: Record
) -> int:
    """Emulate what is not external and finish controller step `done`. Returns as `begin_stations`."""
    time, row = (done + 1) * setup.dt, record.signals[done]
    for j in range(setup.dampers.size):
        x_cmd, x_comp, current, sent = work.begun[j, X_CMD], work.begun[j, X_COMP], work.begun[j, CURRENT], work.begun[j, SENT]
        x_meas, f_meas = work.readings[j, 0], work.readings[j, 1]
        if roles[j] != ALL:
            if roles[j] == NOTHING:
                x = move(j, setup, state, left_out, x_comp, time)
            else:
                x = x_meas if roles[j] == ACTUATOR else sent
            if roles[j] == SPECIMEN:
                force, memory = f_meas, state.memory[j]
                memory[V_TRUE] = (x - memory[X_TRUE]) / setup.dt
                memory[X_TRUE], memory[X_END], memory[F_TRUE] = x, x, force
            else:
                force = react(j, setup, state, left_out, x, current, time)
            x_meas, f_meas = read(j, setup, state, left_out, x, force, setup.noise[done, j], time)
        broken, value = finish(j, setup, state, x_cmd, x_comp, current, x_meas, f_meas, row)
        if broken > 0:
            trip(j, broken, value, done, setup, record)
            return broken
    return 0


@entry
def end_step(i: int, setup: Setup, state: State, work: Work, record: Record) -> None:
    """End integration step i."""
    settle(i, setup, state, work.x_next, record)


def rehearse(setup: Setup, state: State, left_out: LeftOut, work: Work, record: Record) -> None:
    """Compile every piece, or load it, by a step that changes nothing: a rig must not wait for a compiler."""
    state, left_out, record = copy.deepcopy((state, left_out, record._replace(signals=record.signals[: setup.n])))
    roles = np.full(setup.dampers.size, ALL, dtype=np.int64)
    begin_step(0, setup, state, left_out, work)
    begin_stations(0, roles, setup, state, left_out, work, record)
    finish_stations(0, roles, setup, state, left_out, work, record)
    end_step(0, setup, state, work, record)
