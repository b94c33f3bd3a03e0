"""A sensor at the end of its range."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar, Literal

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.physics.search import Seen
from rths_engine.parts.physics.sensor.channel import OfDisplacement, OfForce, Reading, ReadingSearch
from rths_engine.parts.physics.wording import said


class Clipping(Reading):
    """A sensor at the end of its range.

    y = min(max(w, -L), L)

    The sensor or its amplifier does not read beyond L (m or N) in either direction. Neutral: L at its upper bound. No state.
    Not valid where the range is not centred.
    """

    kind: Literal["clipping"] = "clipping"
    limit: float

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.array([self.limit]), np.zeros(1)

    @staticmethod
    def step(p, s, y, x, v, w, t, dt):
        return min(max(y, -p[0]), p[0])


# chosen; see docs/decisions/0030
BEYOND, MOST_BEYOND = 1.02, 0.02  # times the limit, above its ripple in the band of the comparison; share of the samples


class DisplacementClipping(OfDisplacement, Clipping):
    """Clipping of the displacement sensor: x_meas = min(max(x, -L), L)."""

    limit: float = quantity("Limit L", "m", "mm", gt=0, le=1e3, default=1e3)
    title: ClassVar[str] = "Clipping of the displacement sensor"
    neutral: ClassVar = {"limit": 1e3}


class ForceClipping(OfForce, Clipping):
    """Clipping of the load cell: f_meas = min(max(f, -L), L)."""

    limit: float = quantity("Limit L", "N", "kN", gt=0, le=1e12, default=1e12)
    title: ClassVar[str] = "Clipping of the load cell"
    neutral: ClassVar = {"limit": 1e12}


class ClippingSearch(ReadingSearch[Clipping]):
    relatives = ("scale_error",)
    noun = "clipping of the sensor"

    def guesses(self, seen: Seen) -> Iterator[Clipping]:
        for share in (0.7, 0.95):
            yield self.sized(limit=share * self.largest(seen))

    def contradicted(self, effect: Clipping, seen: Seen, measured: Array, step: float) -> str | None:
        share = float(np.mean(np.abs(measured) > BEYOND * effect.limit))
        if share <= MOST_BEYOND:
            return None
        return f"{100 * share:.0f} % of the samples exceed the limit of {said(effect.limit, self.shown)}"

    def says(self, effect: Clipping) -> str:
        return f"does not read beyond ±{said(effect.limit, self.shown)}"
