"""A sensor that reads late or early."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar, Literal

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.physics.delay import HEAD, delayed, ring
from rths_engine.parts.physics.search import Seen
from rths_engine.parts.physics.sensor.channel import OfDisplacement, OfForce, Reading, ReadingSearch
from rths_engine.parts.physics.wording import said


class TimeSkew(Reading):
    """A sensor that reads late or early.

    y(t) = w(t - T)

    A filter or a different clock makes the reading late by T (s), or early for T < 0. An early reading is extrapolated along
    its last slope, which is valid while omega |T| is small. Linear between substeps. Neutral: T = 0.
    State: the ring of `physics.delay`.
    Not valid where a filter also reduces the amplitude.
    """

    kind: Literal["time_skew"] = "time_skew"
    delay: float = quantity("Time skew T (positive: late)", "s", "ms", ge=-0.1, le=0.2, default=0.0)
    neutral: ClassVar = {"delay": 0.0}

    def build(self, dt: float) -> tuple[Array, Array]:
        state = ring(self.delay, dt)
        return np.array([self.delay / dt, len(state) - HEAD]), state

    @staticmethod
    def step(p, s, y, x, v, w, t, dt):
        return delayed(s, int(p[1]), y, p[0])


class DisplacementTimeSkew(OfDisplacement, TimeSkew):
    """Time skew of the displacement sensor: x_meas(t) = x(t - T)."""

    title: ClassVar[str] = "Time skew of the displacement sensor"


class ForceTimeSkew(OfForce, TimeSkew):
    """Time skew of the load cell: f_meas(t) = f(t - T)."""

    title: ClassVar[str] = "Time skew of the load cell"


class TimeSkewSearch(ReadingSearch[TimeSkew]):
    relatives = ("delay_error", "second_order_lag")
    noun = "a time skew of the sensor"

    def guesses(self, seen: Seen) -> Iterator[TimeSkew]:
        yield self.effect(delay=0.005)

    def says(self, effect: TimeSkew) -> str:
        return f"reads {said(abs(effect.delay), 'ms')} {'late' if effect.delay >= 0 else 'early'}"
