"""A structure with more or less damping than its model."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar, Literal

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.physics.effect import MATRICES, Effect
from rths_engine.parts.physics.search import Search, Seen
from rths_engine.parts.physics.wording import said
from rths_engine.parts.structures.assembled import Assembled


class DampingError(Effect):
    """A structure with more or less damping than its model.

    (1 + e) C

    Every modal damping ratio of the structure is off by the share e. Neutral: e = 0.
    Source: Chopra, Dynamics of Structures, chapter 11. Not valid where the error differs between modes.
    """

    kind: Literal["damping_error"] = "damping_error"
    share: float = quantity("Damping error e", "1", "%", ge=-1, le=20, default=0.0)
    title: ClassVar[str] = "Damping error"
    hook: ClassVar[int] = MATRICES
    neutral: ClassVar = {"share": 0.0}

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.zeros(1), np.zeros(1)

    def assembled(self, built: Assembled) -> Assembled:
        return built._replace(damping=(1 + self.share) * built.damping)


class DampingErrorSearch(Search[DampingError]):
    needs = ("x_floor",)
    relatives = ("coulomb_friction", "quadratic_damping")
    noun = "a damping error"

    def guesses(self, seen: Seen) -> Iterator[DampingError]:
        yield self.effect(share=0.2)

    def says(self, effect: DampingError) -> str:
        return f"has {said(abs(effect.share), '%')} {'more' if effect.share >= 0 else 'less'} damping than its model"
