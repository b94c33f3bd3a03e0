"""The start state of a run."""

from __future__ import annotations

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.parts.structures.assembled import Assembled
from rths_engine.planning.model import Model


def state(model: Model, force: Array) -> tuple[Array, Array, Array]:
    """x, v and c of the scheme before step 0, under the external `force` (N) of step 0. Each (n,).

    With A[0] = inv(D + E) R[0] the first step of the scheme is x[1] = x[0] + dt v[0] + (1 + s) dt^2 A[0]. From rest v stays
    zero. Otherwise v changes by -(1/2 + s) dt A[0], so that x[1] = x[0] + dt v[0] + dt^2/2 A[0].
    """
    start, built, scheme, dt = model.plan.start, model.built, model.scheme, model.plan.step
    x, v = (_following(built, given) for given in (start.displacement, start.velocity))
    remembers = scheme.held is not None
    carry = np.zeros_like(x)
    if not len(x) or (start.at_rest and not remembers):
        return x, v, carry
    mean = scheme.effective if scheme.held is None else scheme.effective + scheme.held
    first = np.linalg.solve(mean, force - built.damping @ v - built.stiffness @ x)
    if not start.at_rest:
        v = v - (0.5 + scheme.shift) * dt * first
    if remembers:
        residual = force - built.damping @ v - built.stiffness @ x
        carry = scheme.effective @ first - (1 - scheme.weight) * residual
    return x, v, carry


def _following(built: Assembled, given: tuple[float, ...]) -> Array:
    """All degrees of freedom for the floor values `given`, with no load on the others: x_s = -inv(K_ss) K_sf x_f."""
    x = np.zeros(len(built.mass))
    if not any(given):
        return x
    floors = np.array(built.floors)
    others = np.setdiff1d(np.arange(len(x)), floors)
    x[floors] = given
    if len(others):
        x[others] = -np.linalg.solve(
            built.stiffness[np.ix_(others, others)], built.stiffness[np.ix_(others, floors)] @ x[floors]
        )
    return x
