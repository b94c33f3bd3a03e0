"""Load vectors (inputs, DOF): the force vector for a unit of the ground acceleration (m/s^2) and of each floor force (N)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rths_engine.foundation.arrays import Array
from rths_engine.parts.structures.assembled import Assembled
from rths_engine.planning.plan import Plan


def loads(plan: Plan, built: Assembled) -> Array:
    """The load vectors: -M iota, and 1 at the floor of each force; empty for a test without structure."""
    if plan.driven:
        return np.zeros((0, 0))
    found: Array = np.zeros((1 + len(plan.forces), len(built.mass)))
    found[0] = -built.mass @ built.influence
    for number, force in enumerate(plan.forces, start=1):
        found[number, built.floors[force.floor - 1]] = 1.0
    return found


def pushed(plan: Plan) -> tuple[int, ...]:
    """Floors on which forces act, in the order of the plan's forces."""
    return tuple(dict.fromkeys(force.floor for force in plan.forces))


def columns(plan: Plan) -> NDArray[np.int64]:
    """The recorded column (inputs) to which each input is added: that of the ground, then those of the floors in `pushed`."""
    if plan.driven:
        return np.zeros(0, dtype=np.int64)
    floors = pushed(plan)
    return np.array([0, *(1 + floors.index(force.floor) for force in plan.forces)], dtype=np.int64)
