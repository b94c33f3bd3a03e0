"""A storey stiffer or softer than its model."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar, Literal

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.physics.effect import MATRICES
from rths_engine.parts.physics.search import Seen
from rths_engine.parts.physics.structure.storey import OfStorey, StoreySearch, drift, stiffened, stiffness
from rths_engine.parts.physics.wording import said
from rths_engine.parts.structures.assembled import Assembled


class StiffnessError(OfStorey):
    """A storey stiffer or softer than its model.

    K + e k l^T l,  k = 1 / (l K^-1 l^T)

    The row l maps x to the drift of the storey. k is the stiffness against a pair of forces along the drift; in a shear
    building it is the storey stiffness. K stays positive definite for e > -1. The damping does not change. Neutral: e = 0.
    Source: Chopra, Dynamics of Structures, chapter 9, and the Sherman-Morrison formula.
    Not valid where the columns of adjacent storeys have the same error.
    """

    kind: Literal["stiffness_error"] = "stiffness_error"
    share: float = quantity("Stiffness error e", "1", "%", ge=-0.95, le=10, default=0.0)
    title: ClassVar[str] = "Stiffness error"
    hook: ClassVar[int] = MATRICES
    neutral: ClassVar = {"share": 0.0}

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.zeros(1), np.zeros(1)

    def assembled(self, built: Assembled) -> Assembled:
        self.check(built)
        row = drift(built, self.storey)
        return stiffened(built, self.share * stiffness(built, row) * np.outer(row, row))


class StiffnessErrorSearch(StoreySearch[StiffnessError]):
    relatives = ("mass_error", "p_delta", "base_flexibility")
    noun = "a stiffness error"

    def guesses(self, seen: Seen) -> Iterator[StiffnessError]:
        yield self.effect(storey=seen.storey, share=-0.05)

    def says(self, effect: StiffnessError) -> str:
        return f"is {said(abs(effect.share), '%')} {'stiffer' if effect.share >= 0 else 'softer'} than its model"
