"""A sensor that repeats one reading for some time."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar, Literal

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.physics.gate import past
from rths_engine.parts.physics.search import Seen
from rths_engine.parts.physics.sensor.channel import OfDisplacement, OfForce, Reading, ReadingSearch
from rths_engine.parts.physics.wording import said


class Dropout(Reading):
    """A sensor that repeats one reading for some time.

    y(t) = w(t_0) for t_0 < t <= t_0 + D

    The reading at t_0 (s) is repeated for D (s), because samples were lost. The substep at each end counts by its share.
    Neutral: D = 0. State: s[0] the last reading before t_0. Not valid where lost samples read zero.
    """

    kind: Literal["dropout"] = "dropout"
    time: float = quantity("Start time t₀", "s", ge=0, le=1e5, default=0.0)
    duration: float = quantity("Duration D", "s", ge=0, le=1e5, default=0.0)
    neutral: ClassVar = {"duration": 0.0}

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.array([self.time, self.time + self.duration]), np.zeros(1)

    @staticmethod
    def step(p, s, y, x, v, w, t, dt):
        lost = past(t, p[0], dt) - past(t, p[1], dt)
        if t <= p[0]:
            s[0] = y
        return y + lost * (s[0] - y)


class DisplacementDropout(OfDisplacement, Dropout):
    """Dropout of the displacement sensor: x_meas(t) = x(t_0) for t_0 < t <= t_0 + D."""

    title: ClassVar[str] = "Dropout of the displacement sensor"


class ForceDropout(OfForce, Dropout):
    """Dropout of the load cell: f_meas(t) = f(t_0) for t_0 < t <= t_0 + D."""

    title: ClassVar[str] = "Dropout of the load cell"


class DropoutSearch(ReadingSearch[Dropout]):
    relatives = ("clipping",)
    noun = "a dropout of the sensor"

    def guesses(self, seen: Seen) -> Iterator[Dropout]:
        for part in (0.15, 0.35, 0.55, 0.75):
            yield self.sized(time=part * seen.time, duration=0.1 * seen.time)

    def says(self, effect: Dropout) -> str:
        return f"repeats one reading from {said(effect.time, 's')} on, for {said(effect.duration, 's')}"
