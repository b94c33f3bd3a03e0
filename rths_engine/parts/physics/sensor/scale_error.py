"""A sensor with an error proportional to its reading."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar, Literal

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.physics.search import Seen
from rths_engine.parts.physics.sensor.channel import OfDisplacement, OfForce, Reading, ReadingSearch
from rths_engine.parts.physics.wording import said


class ScaleError(Reading):
    """A sensor with an error proportional to its reading.

    y = (1 + e) w

    The factor of the sensor is off by the share e, because of a wrong calibration or range. Neutral: e = 0. No state.
    Not valid where the error depends on the reading.
    """

    kind: Literal["scale_error"] = "scale_error"
    share: float = quantity("Scale error e", "1", "%", ge=-0.9, le=9, default=0.0)
    neutral: ClassVar = {"share": 0.0}

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.array([self.share]), np.zeros(1)

    @staticmethod
    def step(p, s, y, x, v, w, t, dt):
        return (1.0 + p[0]) * y


class DisplacementScaleError(OfDisplacement, ScaleError):
    """Scale error of the displacement sensor: x_meas = (1 + e) x."""

    title: ClassVar[str] = "Scale error of the displacement sensor"


class ForceScaleError(OfForce, ScaleError):
    """Scale error of the load cell: f_meas = (1 + e) f."""

    title: ClassVar[str] = "Scale error of the load cell"


class ScaleErrorSearch(ReadingSearch[ScaleError]):
    relatives = ("gain_error",)
    proportional = True
    noun = "a scale error of the sensor"

    def guesses(self, seen: Seen) -> Iterator[ScaleError]:
        yield self.effect(share=0.03)

    def says(self, effect: ScaleError) -> str:
        return f"reads {said(abs(effect.share), '%')} too {'much' if effect.share >= 0 else 'little'}"
