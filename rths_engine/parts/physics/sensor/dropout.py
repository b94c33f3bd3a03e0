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


# chosen; see docs/decisions/0030
MOVES = 0.3  # of the standard deviation of the whole reading: a reading that is repeated moves less


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

    def contradicted(self, effect: Dropout, seen: Seen, measured: Array, step: float) -> str | None:
        start, end = (round((effect.time + share * effect.duration) / step) for share in (0.2, 0.8))
        lost = measured[:, start:end]
        if lost.shape[1] < 3 or float(np.max(np.std(lost, axis=1) / np.maximum(np.std(measured, axis=1), 1e-300))) < MOVES:
            return None
        return f"the reading moves between {said(effect.time, 's')} and {said(effect.time + effect.duration, 's')}"

    def says(self, effect: Dropout) -> str:
        return f"repeats one reading from {said(effect.time, 's')} on, for {said(effect.duration, 's')}"
