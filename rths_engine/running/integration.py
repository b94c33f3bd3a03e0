"""One integration step of the structure, with the forces that the stations measured at its start."""

from __future__ import annotations

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.kernel import piece
from rths_engine.parts.physics.effect import STOREY
from rths_engine.running.data import F_MEAS, LeftOut, Setup, State
from rths_engine.running.dispatch import extend_storey, own
from rths_engine.running.restoring import subtract_forces, subtract_product
from rths_engine.running.solve import solve
from rths_engine.running.yield_points import yield_and_push


@piece
def _resist_drifts(t, dt, state, left_out, residual):
    """Subtract from `residual` the forces of the structure's left-out effects, against the drifts of their storeys."""
    x, v = state.x, state.v
    for k in range(left_out.stiffness.size):
        drift, rate = 0.0, 0.0
        for a in range(x.size):
            drift += left_out.drifts[k, a] * x[a]
            rate += left_out.drifts[k, a] * v[a]
        force = extend_storey(STOREY, own(left_out.storeys, k), 0.0, drift, rate, left_out.stiffness[k] * drift, t, dt)
        for a in range(x.size):
            residual[a] -= left_out.drifts[k, a] * force


@piece
def integrate(
    i: int, setup: Setup, state: State, left_out: LeftOut | None, residual: Array, work: Array, x_next: Array
) -> None:
    """x[i+1] into x_next and v[i+1] into state.v by the scheme (`integrators.scheme`), with the measured forces of step i."""
    x, v = state.x, state.v
    for a in range(x.size):
        residual[a] = 0.0
    for k in range(setup.loads.shape[0]):
        for a in range(x.size):
            residual[a] += setup.loads[k, a] * setup.inputs[i, k]
    for j in range(setup.dampers.size):
        force = setup.dampers[j] * state.memory[j, F_MEAS]
        for a in range(x.size):
            residual[a] -= setup.drifts[j, a] * force
    subtract_product(setup.damping, v, residual)
    subtract_product(setup.elastic, x, residual)
    subtract_forces(setup.members, x, state.plastic, residual)
    yield_and_push(setup.points, state.points, x, setup.weight, setup.shift, setup.dt_step, residual)
    if left_out is not None:
        _resist_drifts(i * setup.dt_step, setup.dt_step, state, left_out, residual)
    remembers = setup.held.value.size > 0
    if remembers:
        for a in range(x.size):
            now = residual[a]
            residual[a] = (1.0 - setup.weight) * now + state.carry[a]
            state.carry[a] = setup.weight * now
    solve(setup.factor, residual, work, x_next)
    if remembers:
        subtract_product(setup.held, x_next, state.carry)
    for a in range(x.size):
        v[a] += setup.dt_step * x_next[a]
        x_next[a] = x[a] + setup.dt_step * (v[a] + setup.shift * setup.dt_step * x_next[a])
