"""A ground motion of another size than recorded."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar, Literal, Self

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.physics.effect import GROUND, Effect, Seen
from rths_engine.parts.physics.wording import said


class GroundScaleError(Effect):
    """a = (1 + e) a_g

    The table shakes by another factor than recorded. Neutral: e = 0. Fails first where the table loses one band only.
    """

    kind: Literal["scale_error"] = "scale_error"
    share: float = quantity("Scale error e", "1", "%", ge=-0.9, le=9, default=0.0)
    title: ClassVar[str] = "Scale error of the ground motion"
    hook: ClassVar[int] = GROUND
    neutral: ClassVar = {"share": 0.0}
    needs: ClassVar = ("ag",)
    relatives: ClassVar = ("low_pass",)
    noun: ClassVar[str] = "a scale error of the ground motion"

    @classmethod
    def guesses(cls, seen: Seen) -> Iterator[Self]:
        yield cls(share=0.05)

    def says(self) -> str:
        return f"is {said(abs(self.share), '%')} {'stronger' if self.share >= 0 else 'weaker'} than recorded"

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.zeros(1), np.zeros(1)

    def shaken(self, ground: Array, dt: float) -> Array:
        return (1 + self.share) * ground
