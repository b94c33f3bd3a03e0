"""Compliance in series with the specimen."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar, Literal

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.physics.effect import SERIES, Effect
from rths_engine.parts.physics.search import TINY, Search, Seen
from rths_engine.parts.physics.wording import said


class SeriesCompliance(Effect):
    """Compliance in series with the specimen.

    u + phi f(u) = x

    phi (m/N) is the flexibility of clevises, load cell or frame between the measured displacement x and the specimen's end u.
    The equation is solved in every substep together with the law of the specimen. Neutral: phi = 0. No state.
    Not valid where the supports have mass.
    """

    kind: Literal["series_compliance"] = "series_compliance"
    flexibility: float = quantity("Flexibility φ", "m/N", "mm/kN", ge=0, le=1, default=0.0)
    title: ClassVar[str] = "Series compliance"
    hook: ClassVar[int] = SERIES
    neutral: ClassVar = {"flexibility": 0.0}

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.array([self.flexibility]), np.zeros(1)

    @staticmethod
    def step(p, s, y, x, v, w, t, dt):
        return y + p[0]


class SeriesComplianceSearch(Search[SeriesCompliance]):
    needs = ("x_meas", "f_meas")
    relatives = ("backlash", "coulomb_friction")
    noun = "series compliance"

    def guesses(self, seen: Seen) -> Iterator[SeriesCompliance]:
        for share in (0.005, 0.03, 0.15):
            yield self.sized(flexibility=share / max(seen.stiffness, TINY))

    def says(self, effect: SeriesCompliance) -> str:
        return f"has a flexibility of {said(effect.flexibility, 'mm/kN')} in its connection"
