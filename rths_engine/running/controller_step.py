"""Controller steps of all stations within an integration step, and its two ends: what every loop over a test is made of.

A loop over integration step i calls `integrate`, then `find_ends`, `controller_step` for q = 1 to n, then `settle`. Where a
station needs another program or machine within the step, a loop writes `record_structure` and each station's own pieces
(`station`) in place of `controller_step`.
"""

from __future__ import annotations

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.kernel import piece
from rths_engine.running.data import LeftOut, Record, Setup, State
from rths_engine.running.station import emulated_step


@piece
def find_ends(i: int, setup: Setup, state: State, x_next: Array, ends: Array) -> None:
    """The commands of the stations at both ends of integration step i into `ends` (S, 2), m: L x plus the drive (8)."""
    x = state.x
    for j in range(setup.dampers.size):
        ends[j, 0], ends[j, 1] = setup.drive[i, j], setup.drive[i + 1, j]
        for a in range(x.size):
            ends[j, 0] += setup.drifts[j, a] * x[a]
            ends[j, 1] += setup.drifts[j, a] * x_next[a]


@piece
def commanded(ends: Array, j: int, share: float) -> float:
    """The command (m) of station j at a share of the integration step."""
    return ends[j, 0] + share * (ends[j, 1] - ends[j, 0])


@piece
def record_structure(i: int, share: float, setup: Setup, state: State, x_next: Array, row: Array) -> None:
    """The inputs and the displacements of the floors at a share of integration step i, into the first columns of a row."""
    x, floors, inputs = state.x, setup.floors, setup.loads.shape[0]
    for k in range(inputs):
        row[k] = setup.inputs[i, k] + share * (setup.inputs[i + 1, k] - setup.inputs[i, k])
    for f in range(floors.size):
        a = floors[f]
        row[inputs + f] = x[a] + share * (x_next[a] - x[a])


@piece
def trip(j: int, broken: int, value: float, done: int, setup: Setup, record: Record) -> None:
    """Record that a limit of station j was exceeded in substep `done`, counted from 0."""
    record.trip[0], record.trip[1] = j, value
    record.trip[2], record.trip[3] = setup.limits[j, broken - 1], done + 1


@piece
def step_stations(
    done: int, share: float, setup: Setup, state: State, left_out: LeftOut | None, ends: Array, record: Record
) -> int:
    """Controller step `done`, counted from 0, of all stations with their emulated rigs, at a share of their motion to its ends.

    Returns 0 or the position plus 1 of the exceeded limit.
    """
    time = (done + 1) * setup.dt
    row = record.signals[done]
    for j in range(setup.dampers.size):
        x_cmd = commanded(ends, j, share)
        broken, value = emulated_step(j, setup, state, left_out, x_cmd, setup.noise[done, j], time, row)
        if broken > 0:
            trip(j, broken, value, done, setup, record)
            return broken
    return 0


@piece
def controller_step(
    i: int, q: int, setup: Setup, state: State, left_out: LeftOut | None, x_next: Array, ends: Array, record: Record
) -> int:
    """Controller step q, from 1 to n, of integration step i into its row. Returns as `step_stations`."""
    done, share = i * setup.n + q - 1, q / setup.n
    record_structure(i, share, setup, state, x_next, record.signals[done])
    return step_stations(done, share, setup, state, left_out, ends, record)


@piece
def settle(i: int, setup: Setup, state: State, x_next: Array, record: Record) -> None:
    """End integration step i: its displacements and velocities become the state, and those of the floors the history."""
    for a in range(x_next.size):
        state.x[a] = x_next[a]
    for f in range(setup.floors.size):
        record.history[i + 1, 0, f] = state.x[setup.floors[f]]
        record.history[i + 1, 1, f] = state.v[setup.floors[f]]
