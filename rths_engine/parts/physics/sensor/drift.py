"""A sensor whose zero moves."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar, Literal

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.physics.search import Seen
from rths_engine.parts.physics.sensor.channel import OfDisplacement, OfForce, Reading, ReadingSearch
from rths_engine.parts.physics.wording import said


class Drift(Reading):
    """A sensor whose zero moves.

    y = w + r t

    The zero of the sensor moves by r (m/s or N/s), for example while its amplifier warms up. Neutral: r = 0. No state.
    Not valid where the drift levels out during the test.
    """

    kind: Literal["drift"] = "drift"
    rate: float
    neutral: ClassVar = {"rate": 0.0}

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.array([self.rate]), np.zeros(1)

    @staticmethod
    def step(p, s, y, x, v, w, t, dt):
        return y + p[0] * t


class DisplacementDrift(OfDisplacement, Drift):
    """Drift of the displacement sensor: x_meas = x + r t."""

    rate: float = quantity("Rate r", "m/s", "mm/s", ge=-1, le=1, default=0.0)
    title: ClassVar[str] = "Drift of the displacement sensor"


class ForceDrift(OfForce, Drift):
    """Drift of the load cell: f_meas = f + r t."""

    rate: float = quantity("Rate r", "N/s", "kN/s", ge=-1e9, le=1e9, default=0.0)
    title: ClassVar[str] = "Drift of the load cell"


class DriftSearch(ReadingSearch[Drift]):
    relatives = ("offset",)
    proportional = True
    noun = "a drift of the sensor"

    def guesses(self, seen: Seen) -> Iterator[Drift]:
        yield self.sized(rate=0.05 * self.largest(seen) / max(seen.time, seen.dt))

    def says(self, effect: Drift) -> str:
        return f"drifts by {said(effect.rate, self.shown + '/s')}"
