"""Gravity load that acts on the drift (P-delta effect)."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar, Literal

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.physics.effect import MATRICES, Effect
from rths_engine.parts.physics.search import Search, Seen
from rths_engine.parts.physics.structure.storey import drift, stiffened
from rths_engine.parts.physics.wording import said
from rths_engine.parts.structures.assembled import Assembled


class PDelta(Effect):
    """Gravity load that acts on the drift (P-delta effect).

    K - mu lambda K_G,  K_G = sum over storeys of W_s l_s^T l_s,  lambda the least root of det(K - lambda K_G) = 0

    W_s (kg) is the mass above storey s, and the row l_s maps x to the drift of storey s. All storeys have the same height. mu
    is the gravity load as a share of lambda K_G, the load at which the structure buckles sideways; K stays positive definite
    for mu < 1. For one storey mu is the stability coefficient W g / (k h). Neutral: mu = 0.
    Source: the linearised geometric stiffness of Wilson and Habibullah (1987), Earthquake Spectra 3, 289-298.
    Not valid where the structure yields or where storeys differ in height.
    """

    kind: Literal["p_delta"] = "p_delta"
    load: float = quantity("Gravity load over buckling load μ", "1", "%", ge=0, le=0.95, default=0.0)
    title: ClassVar[str] = "P-delta"
    hook: ClassVar[int] = MATRICES
    neutral: ClassVar = {"load": 0.0}

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.zeros(1), np.zeros(1)

    def assembled(self, built: Assembled) -> Assembled:
        masses = (built.mass @ built.influence)[list(built.floors)]
        above = np.cumsum(masses[::-1])[::-1]
        rows = np.array([drift(built, storey) for storey in range(1, len(masses) + 1)]).reshape(-1, len(built.mass))
        geometric = rows.T @ (above[:, None] * rows)
        largest = np.linalg.eigvals(np.linalg.solve(built.stiffness, geometric)).real.max(initial=0.0)
        return stiffened(built, -self.load / largest * geometric) if largest > 0 else built


class PDeltaSearch(Search[PDelta]):
    needs = ("x_floor",)
    relatives = ("stiffness_error", "base_flexibility")
    noun = "the P-delta effect"

    def guesses(self, seen: Seen) -> Iterator[PDelta]:
        yield self.effect(load=0.05)

    def says(self, effect: PDelta) -> str:
        return f"is softened by its gravity load, which is {said(effect.load, '%')} of the load at which it buckles sideways"
