"""The start of a structure that a recording shows in its first samples."""

from __future__ import annotations

import numpy as np
from scipy.linalg import eigh

from rths_engine.foundation.arrays import Array
from rths_engine.planning.model import Model
from rths_engine.planning.plan import Plan
from rths_engine.recordings.measured import Measured

# chosen; see docs/decisions/0023
AT_REST = 0.02  # of the largest displacement: with less at the start, the structure counts as at rest
FIRST_MOMENTS = 0.12  # of the first period: the samples that determine the start
Released = tuple[tuple[float, ...], tuple[float, ...]]  # displacements (m) and velocities (m/s) of the floors


def released_start(plan: Plan, recording: Measured, ground: Array, forces: dict[int, Array]) -> Released | None:
    """Displacements and velocities of the floors at the start; None where the structure is at rest.

    A cubic polynomial is fitted to the first samples of each floor. Where only accelerations were measured, the first mode
    gives the displacements.
    """
    count = len(plan.structure.assemble().floors)
    period = float(Model(plan).periods[0])
    few = max(8, min(recording.samples, round(FIRST_MOMENTS * period / recording.dt)))
    time = np.arange(few) * recording.dt
    x, v, moving = [0.0] * count, [0.0] * count, False
    for floor in range(1, count + 1):
        if not recording.has("x_floor", floor):
            continue
        values = recording.get("x_floor", floor)
        law = np.append(
            np.polynomial.Polynomial.fit(time, values[:few], 3).convert().coef, 0.0
        )  # zeros at its end are left out
        x[floor - 1], v[floor - 1] = float(law[0]), float(law[1])
        moving = moving or abs(law[0]) > AT_REST * float(np.max(np.abs(values)))
    still = not ground.any() and not any(np.any(force) for force in forces.values())
    if not any(x) and still:
        x = _by_acceleration(plan, recording, few)
    return (tuple(x), tuple(v)) if moving or still else None


def _by_acceleration(plan: Plan, recording: Measured, few: int) -> list[float]:
    """Displacements x = -a / omega_1^2 at the start; the measured accelerations a give the size of the first mode."""
    built = plan.structure.assemble()
    flexible, modes = eigh(built.mass, built.stiffness)  # 1 / omega^2, rising
    shape = modes[list(built.floors), -1]
    measured = [floor for floor in range(1, len(shape) + 1) if recording.has("a_floor", floor)]
    if not measured:
        return [0.0] * len(shape)
    time = np.arange(few) * recording.dt
    begun = [np.polynomial.Polynomial.fit(time, recording.get("a_floor", one)[:few], 3)(0.0) for one in measured]
    seen = shape[[one - 1 for one in measured]]
    size = float(seen @ np.array(begun) / (seen @ seen))
    return [float(one) for one in -size * flexible[-1] * shape]
