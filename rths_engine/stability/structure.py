"""The structure and its integrator about rest, reduced to the coordinates that stations and ground excite."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.linalg import lu_factor, lu_solve

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import Issue, PlanError
from rths_engine.planning.model import Model

# chosen; see docs/decisions/0023
MOST = 300  # coordinates of the reduced structure: the eigenvalues of the loop are computed some hundred times
REACHED = 1e-9  # a remaining direction with a smaller share of its length is rounding


@dataclass(frozen=True, slots=True)
class LinearStructure:
    """q[i+1] = a q[i] - b f[i] with the stations' forces f (N) and their strokes x_cmd[i] = d q[i].

    From `integrators.scheme` with the initial K and R[i] = -C v[i] - K x[i] - L^T f[i]. (x, dt v, dt^2 inv(D) c) = basis q,
    without c for a scheme that does not use the last step. The basis spans everything that the columns of L^T and of M iota
    excite in any number of steps, so that the motion of the stations is exact. a (r, r), b (r, S), d (S, r). Degrees of freedom
    that are not excited drop out; massless rotations and vertical displacements follow the others.
    Not valid when members yield.
    """

    a: Array
    b: Array
    d: Array


def linear(model: Model) -> LinearStructure:
    """The structure of a plan with its integrator. Raises PlanError for a mechanism or too many independent motions."""
    built, drifts, dt, scheme = model.built, model.drifts, model.plan.step, model.scheme
    factor = lu_factor(scheme.effective)
    dof, weight = len(built.mass), scheme.weight

    def moved(state: Array, force: Array) -> Array:
        """The state after a step under a force R in addition to its own forces."""
        x, move = state[:dof], state[dof : 2 * dof]
        pushed = dt**2 * lu_solve(factor, force - built.stiffness @ x - built.damping @ move / dt)
        change = pushed if scheme.held is None else (1 - weight) * pushed + state[2 * dof :]
        parts = [x + move + (1 + scheme.shift) * change, move + change]
        if scheme.held is not None:
            parts.append(weight * pushed - lu_solve(factor, scheme.held @ change))
        return np.concatenate(parts)

    rest = np.zeros((2 if scheme.held is None else 3) * dof)

    def step(state: Array) -> Array:
        return moved(state, np.zeros(dof))

    def pushed(force: Array) -> Array:
        return np.array([moved(rest, one) for one in np.atleast_2d(force)]).reshape(-1, len(rest)).T

    forces = pushed(drifts)
    basis, images = _reached(step, np.column_stack([forces, pushed(built.mass @ built.influence)]))
    return LinearStructure(basis.T @ images, basis.T @ forces, drifts @ basis[:dof])


def _reached(step: Callable[[Array], Array], starts: Array) -> tuple[Array, Array]:
    """Orthonormal basis (N, r) of the states that repeated steps reach from `starts`, and the basis after one step."""
    basis: Array = np.zeros((len(starts), 0))
    images: Array = np.zeros((len(starts), 0))
    waiting = deque(starts.T)
    while waiting and basis.shape[1] < len(starts):
        one = waiting.popleft()
        if basis.shape[1] == MOST:
            problem = f"has more than {MOST} independent motions, for which stability is not predicted"
            raise PlanError(Issue("structure", problem, fix="reduce it to fewer degrees of freedom"))
        length = np.linalg.norm(one)
        for _ in range(2):  # twice: a single projection leaves rounding errors
            one = one - basis @ (basis.T @ one)
        rest = np.linalg.norm(one)
        if length == 0 or rest <= REACHED * length:
            continue
        basis = np.column_stack([basis, one / rest])
        images = np.column_stack([images, step(one / rest)])
        waiting.append(images[:, -1])
    return basis, images
