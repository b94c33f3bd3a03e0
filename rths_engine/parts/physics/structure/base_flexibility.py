"""A base that sways."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar, Literal

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import quantity
from rths_engine.parts.physics.effect import MATRICES, Effect
from rths_engine.parts.physics.search import TINY, Search, Seen
from rths_engine.parts.physics.wording import said
from rths_engine.parts.structures.assembled import Assembled, Members

HORIZONTAL = (0, 3)  # places in a member's six end displacements


class BaseFlexibility(Effect):
    """A base that sways.

    V = b / phi: one more degree of freedom b without mass, y = x - iota b,  K -> T^T K T + e e^T / phi,  T = [1, -iota]

    The structure, with the dampers of its lowest storey, stands on a spring of flexibility phi (m/N), which carries the base
    shear V. x stays relative to the ground. The period of a single storey becomes longer by the factor sqrt(1 + phi k).
    Neutral: phi = 0.
    Source: Veletsos and Meek (1974), EESD 3, 121-138, the sway of a structure on its soil.
    Not valid where the base also rocks.
    """

    kind: Literal["base_flexibility"] = "base_flexibility"
    flexibility: float = quantity("Flexibility φ", "m/N", "mm/kN", ge=0, le=1, default=0.0)
    title: ClassVar[str] = "Base flexibility"
    hook: ClassVar[int] = MATRICES
    neutral: ClassVar = {"flexibility": 0.0}

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.zeros(1), np.zeros(1)

    def assembled(self, built: Assembled) -> Assembled:
        if self.flexibility == 0.0:
            return built
        count = len(built.mass)
        relative = np.column_stack([np.eye(count), -built.influence])
        spring = np.zeros((count + 1, count + 1))
        spring[count, count] = 1 / self.flexibility
        return Assembled(
            np.pad(built.mass, (0, 1)),
            relative.T @ built.damping @ relative,
            relative.T @ built.stiffness @ relative + spring,
            relative.T @ built.elastic @ relative + spring,
            np.append(built.influence, 0.0),
            built.floors,
            built.drifts @ relative,
            _standing(built.members, count),
            base=count,
        )


def _standing(members: Members, base: int) -> Members:
    """The members, with their supported ends attached to the base in the horizontal direction."""
    dofs = members.dofs.copy()
    for end in HORIZONTAL:
        dofs[dofs[:, end] < 0, end] = base
    return members._replace(dofs=dofs)


class BaseFlexibilitySearch(Search[BaseFlexibility]):
    needs = ("x_floor",)
    relatives = ("stiffness_error", "p_delta")
    noun = "base flexibility"

    def guesses(self, seen: Seen) -> Iterator[BaseFlexibility]:
        yield self.sized(flexibility=0.05 / max(seen.stiffness, TINY))

    def says(self, effect: BaseFlexibility) -> str:
        return f"moves at its base by {said(effect.flexibility, 'mm/kN')} of base shear"
