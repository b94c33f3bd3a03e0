"""Yielding of a condensed frame, compiled: bilinear points whose plastic curvatures load a linear frame.

A frame that yields is its initial, linear frame under the loads of its plastic curvatures. Its degrees of freedom without mass
or load are condensed (`running.condensed`), and with them everything but the kept displacements and the points themselves.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.kernel import piece


class YieldPoints(NamedTuple):
    """The constant data of Q points that can yield, in a frame of m kept degrees of freedom."""

    curvature: Any  # (m, Q), 1/m: curvatures by a unit of each kept displacement, while the others follow statically
    pushed: Any  # (Q, m), N m: force on the kept degrees of freedom by a unit of yielding of each point
    bent: Any  # (Q, Q): static curvature of all points by a unit of yielding of each point (row)
    limit: Any  # (Q), 1/m: yield curvature My / EI
    damping: float  # a1 (s) of C = a1 K, in the condensed degrees of freedom
    effective: float  # D = effective K of the scheme, there (s^2)
    held: float  # E = held K of the scheme, there (s^2)


class PointStates(NamedTuple):
    """What changes at the points, in place. The offset is the curvature beyond that of the kept displacements."""

    centre: Any  # (Q), 1/m: middle of the elastic range
    static: Any  # (Q), 1/m: the offset that the yielding would cause at rest
    offset: Any  # (Q), 1/m
    rate: Any  # (Q), 1/(m s), of the offset
    carry: Any  # (Q), c of the scheme for the offset
    force: Any  # (m), N: of all yielding, on the kept degrees of freedom
    moving: Any  # (1): whether an offset is or was not zero
    beyond: Any  # (Q): work space


def no_points(count: int) -> YieldPoints:
    """Empty tables, for a structure of `count` degrees of freedom without points that yield."""
    return YieldPoints(np.zeros((count, 0)), np.zeros((0, count)), np.zeros((0, 0)), np.zeros(0), 0.0, 1.0, 0.0)


def at_rest(points: YieldPoints) -> PointStates:
    """The state of points that have not yielded yet."""
    count = points.limit.size
    centre, static, offset, rate, carry, beyond = np.zeros((6, count))
    force: Array = np.zeros(len(points.curvature))
    return PointStates(centre, static, offset, rate, carry, force, np.zeros(1, dtype=np.int64), beyond)


@piece
def yield_and_push(points, state, x, weight, shift, dt, residual):
    """Yield under the kept displacements x, add the forces of the yielding to the residual, and move the offsets by a step.

    With z = kappa - centre, a point yields by the excess of |z| over its limit, which moves the centre by as much: the bilinear
    law, with kinematic hardening and exact return mapping. The offsets q follow the scheme, as the condensed equations do:
    effective A = (1 - w) R + c,  c = w R - held A,  R = static - q - a1 q'.
    """
    count = points.limit.size
    if count == 0:
        return
    beyond, offset = state.beyond, state.offset
    for k in range(count):
        beyond[k] = offset[k] - state.centre[k]
    for f in range(x.size):
        moved, row = x[f], points.curvature[f]
        for k in range(count):
            beyond[k] += row[k] * moved
    yielding = 0
    for k in range(count):
        yielding += abs(beyond[k]) > points.limit[k]
    if yielding > 0:
        state.moving[0] = 1
        for k in range(count):
            excess = abs(beyond[k]) - points.limit[k]
            if excess > 0.0:
                if beyond[k] < 0.0:
                    excess = -excess
                state.centre[k] += excess
                for f in range(x.size):
                    state.force[f] += points.pushed[k, f] * excess
                row = points.bent[k]
                for other in range(count):
                    state.static[other] += row[other] * excess
    for f in range(x.size):
        residual[f] += state.force[f]
    if state.moving[0] == 0:
        return
    now, inverse, shifted = 1.0 - weight, 1.0 / points.effective, shift * dt
    for k in range(count):
        rest = state.static[k] - offset[k] - points.damping * state.rate[k]
        acceleration = (now * rest + state.carry[k]) * inverse
        state.carry[k] = weight * rest - points.held * acceleration
        state.rate[k] += dt * acceleration
        offset[k] += dt * (state.rate[k] + shifted * acceleration)
