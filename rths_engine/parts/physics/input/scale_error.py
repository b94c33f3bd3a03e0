"""A ground motion larger or smaller than recorded."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar, Literal

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.physics.effect import GROUND, Effect
from rths_engine.parts.physics.search import Search, Seen
from rths_engine.parts.physics.wording import said


class GroundScaleError(Effect):
    """A ground motion larger or smaller than recorded.

    a = (1 + e) a_g

    The amplitude of the shaking differs from the record by the share e. Neutral: e = 0.
    Not valid where the shaking table attenuates one frequency band only.
    """

    kind: Literal["scale_error"] = "scale_error"
    share: float = quantity("Scale error e", "1", "%", ge=-0.9, le=9, default=0.0)
    title: ClassVar[str] = "Scale error of the ground motion"
    hook: ClassVar[int] = GROUND
    neutral: ClassVar = {"share": 0.0}

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.zeros(1), np.zeros(1)

    def shaken(self, ground: Array, dt: float) -> Array:
        return (1 + self.share) * ground


class GroundScaleErrorSearch(Search[GroundScaleError]):
    needs = ("ag",)
    relatives = ("low_pass",)
    noun = "a scale error of the ground motion"

    def guesses(self, seen: Seen) -> Iterator[GroundScaleError]:
        yield self.effect(share=0.05)

    def says(self, effect: GroundScaleError) -> str:
        return f"is {said(abs(effect.share), '%')} {'stronger' if effect.share >= 0 else 'weaker'} than recorded"
