"""The fields that every integrator has: its step, and the substeps of the command ramp."""

from __future__ import annotations

import math
from typing import ClassVar

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import Value, quantity
from rths_engine.parts.integrators.scheme import Scheme


class Stepping(Value):
    """An integrator. `build` returns its scheme for M (kg), C (N s/m), K (N/m), (n, n) each, with the stations' equivalents."""

    dt: float = quantity("Integration step Δt", "s", "ms", gt=0, le=0.1, default=10 / 1024)
    substeps: int = quantity(
        "Substeps per step n",
        ge=1,
        le=1000,
        default=10,
        help="controller steps of the command ramp per integration step",
    )
    title: ClassVar[str]
    stable_up_to: ClassVar[float] = math.inf  # omega dt of the highest mode of a linear elastic structure

    def build(self, mass: Array, damping: Array, stiffness: Array) -> Scheme:
        raise NotImplementedError
