"""A floor heavier or lighter than its model."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import ClassVar, Literal

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.physics.effect import MATRICES
from rths_engine.parts.physics.search import Seen
from rths_engine.parts.physics.structure.storey import OfStorey, StoreySearch
from rths_engine.parts.physics.wording import said
from rths_engine.parts.structures.assembled import Assembled


class MassError(OfStorey):
    """A floor heavier or lighter than its model.

    S M S,  S = diag(1, .., sqrt(1 + e), .., 1)

    The mass of the floor on top of the storey is off by the share e. In a mass matrix that is not diagonal, the coupling terms
    of the floor scale by sqrt(1 + e), so that the matrix stays positive. The damping does not change. Neutral: e = 0.
    Source: Chopra, Dynamics of Structures, chapter 9. Not valid where the floor's rotational mass matters.
    """

    kind: Literal["mass_error"] = "mass_error"
    share: float = quantity("Mass error e", "1", "%", ge=-0.95, le=10, default=0.0)
    title: ClassVar[str] = "Mass error"
    hook: ClassVar[int] = MATRICES
    neutral: ClassVar = {"share": 0.0}

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.zeros(1), np.zeros(1)

    def assembled(self, built: Assembled) -> Assembled:
        self.check(built)
        scale = np.ones(len(built.mass))
        scale[built.floors[self.storey - 1]] = math.sqrt(1 + self.share)
        return built._replace(mass=built.mass * np.outer(scale, scale))


class MassErrorSearch(StoreySearch[MassError]):
    relatives = ("stiffness_error",)
    noun = "a mass error"

    def guesses(self, seen: Seen) -> Iterator[MassError]:
        yield self.effect(storey=seen.storey, share=0.05)

    def says(self, effect: MassError) -> str:
        return f"has a floor {said(abs(effect.share), '%')} {'heavier' if effect.share >= 0 else 'lighter'} than in its model"
