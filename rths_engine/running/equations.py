"""The equations that the loop integrates: those of the model, or fewer (`running.condensed_frame`)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.factor import Factor
from rths_engine.parts.structures.assembled import Members
from rths_engine.planning.model import Model
from rths_engine.running.yield_points import PointStates, YieldPoints, at_rest, no_points


@dataclass(frozen=True)
class Following:
    """The degrees of freedom `rest` that are condensed: x_s = static x_k + y, where y bends the Q points."""

    rest: NDArray[np.int64]
    static: Array  # (n - m, m): -inv(K_ss) K_sk
    bending: Array  # (Q, n - m): curvatures of the points by each displacement y
    flexible: Array  # (Q, n - m): curvatures of the points by a static force on each of these degrees of freedom


@dataclass(frozen=True)
class Equations:
    """Equations of m degrees of freedom, those numbered `kept` among the n of the model; I inputs, S stations."""

    kept: NDArray[np.int64]
    factor: Factor  # of D (m, m)
    held: Array | None  # E (m, m)
    damping: Array  # C (m, m)
    elastic: Array  # (m, m), stiffness beside the members
    loads: Array  # (I, m)
    drifts: Array  # (S, m)
    members: Members
    points: YieldPoints
    following: Following | None = None

    def start(self, x: Array, v: Array, carry: Array) -> tuple[Array, Array, Array, PointStates]:
        """The start state of these equations, from that of the model's equations (n,)."""
        states = at_rest(self.points)
        if self.following is None:
            return x, v, carry, states
        rest, static, bending = self.following.rest, self.following.static, self.following.bending
        states.offset[:] = bending @ (x[rest] - static @ x[self.kept])
        states.rate[:] = bending @ (v[rest] - static @ v[self.kept])
        states.carry[:] = self.following.flexible @ carry[rest]
        states.moving[0] = states.offset.any() or states.rate.any() or states.carry.any()
        return x[self.kept], v[self.kept], carry[self.kept] + static.T @ carry[rest], states


def whole(model: Model) -> Equations:
    """The equations of all degrees of freedom of a model."""
    built = model.built
    return Equations(
        np.arange(len(built.mass)),
        model.factor,
        model.scheme.held,
        built.damping,
        built.elastic,
        model.loads,
        model.drifts,
        built.members,
        no_points(len(built.mass)),
    )
