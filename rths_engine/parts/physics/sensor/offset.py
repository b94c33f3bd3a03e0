"""A sensor with a constant error."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar, Literal

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.physics.search import Seen
from rths_engine.parts.physics.sensor.channel import OfDisplacement, OfForce, Reading, ReadingSearch
from rths_engine.parts.physics.wording import said


class Offset(Reading):
    """A sensor with a constant error.

    y = w + o

    The zero of the sensor is off by o (m or N): a transducer moved, or a bridge was not balanced. Neutral: o = 0. No state.
    Not valid where the zero moves with time.
    """

    kind: Literal["offset"] = "offset"
    error: float
    neutral: ClassVar = {"error": 0.0}

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.array([self.error]), np.zeros(1)

    @staticmethod
    def step(p, s, y, x, v, w, t, dt):
        return y + p[0]


class DisplacementOffset(OfDisplacement, Offset):
    """Offset of the displacement sensor: x_meas = x + o."""

    error: float = quantity("Offset o", "m", "mm", ge=-1, le=1, default=0.0)
    title: ClassVar[str] = "Offset of the displacement sensor"


class ForceOffset(OfForce, Offset):
    """Offset of the load cell: f_meas = f + o."""

    error: float = quantity("Offset o", "N", "kN", ge=-1e9, le=1e9, default=0.0)
    title: ClassVar[str] = "Offset of the load cell"


class OffsetSearch(ReadingSearch[Offset]):
    relatives = ("drift",)
    proportional = True
    noun = "an offset of the sensor"

    def guesses(self, seen: Seen) -> Iterator[Offset]:
        yield self.sized(error=0.02 * self.largest(seen))

    def says(self, effect: Offset) -> str:
        return f"reads {said(abs(effect.error), self.shown)} too {'high' if effect.error >= 0 else 'low'}"
