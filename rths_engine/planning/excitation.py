"""The excitation of a test besides ground motion: a drive, forces on floors, and a start away from rest."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import Value, quantity
from rths_engine.planning.shapes import Shape, Sine, Still

Displacement = Annotated[float, Field(ge=-10, le=10)]
Velocity = Annotated[float, Field(ge=-100, le=100)]


class Drive(Value):
    """The displacement command of the station in a test of a specimen or an actuator: amplitude times shape."""

    amplitude: float = quantity("Amplitude", "m", "mm", ge=-10, le=10, default=0.02)
    shape: Shape = Field(Still(), title="Shape")

    def sample(self, time: Array) -> Array:
        return np.asarray(self.amplitude * self.shape.sample(time))


class FloorForce(Value):
    """A force on a floor: amplitude times shape, positive in the direction of the floor's displacement."""

    floor: int = quantity("Floor", ge=1, le=2000, default=1)
    amplitude: float = quantity("Amplitude", "N", "kN", ge=-1e10, le=1e10, default=1e5)
    shape: Shape = Field(Sine(), title="Shape")

    def sample(self, time: Array) -> Array:
        return np.asarray(self.amplitude * self.shape.sample(time))


class Start(Value):
    """Displacements and velocities of the floors at the start; the other degrees of freedom follow them statically."""

    displacement: tuple[Displacement, ...] = quantity(
        "Displacement of each floor", "m", "mm", default=(), max_length=2000, help="empty: zero"
    )
    velocity: tuple[Velocity, ...] = quantity(
        "Velocity of each floor", "m/s", "mm/s", default=(), max_length=2000, help="empty: zero"
    )

    @property
    def at_rest(self) -> bool:
        return not any(self.displacement) and not any(self.velocity)
