"""Effects of one storey of a structure."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar, TypeVar

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import Issue, PlanError
from rths_engine.foundation.part import quantity
from rths_engine.parts.physics.effect import STOREY, Effect
from rths_engine.parts.physics.search import Search, Seen
from rths_engine.parts.structures.assembled import Assembled


class OfStorey(Effect):
    """An effect of one storey: the force y depends on the drift of storey s and acts against the drift."""

    storey: int = quantity("Storey", ge=1, le=100, default=1, help="storey 1 is the lowest")
    hook: ClassVar[int] = STOREY

    def check(self, built: Assembled) -> None:
        """Raises PlanError where the structure does not have this storey."""
        count = len(built.floors)
        if self.storey > count:
            fix = f"give a storey from 1 to {count}"
            raise PlanError(Issue("storey", f"the structure has {count} storeys", self.storey, fix))


S = TypeVar("S", bound=OfStorey)


class StoreySearch(Search[S]):
    """Search for an effect in each storey separately."""

    needs: tuple[str, ...] = ("x_floor",)

    def guesses(self, seen: Seen) -> Iterator[S]:
        for guess in super().guesses(seen):
            yield guess.model_copy(update={"storey": seen.storey})


def drift(built: Assembled, storey: int) -> Array:
    """The row (n) that maps x to the drift of a storey; storeys count from 1."""
    row: Array = np.zeros(len(built.mass))
    row[built.floors[storey - 1]] = 1.0
    below = built.floors[storey - 2] if storey > 1 else built.base
    if below >= 0:
        row[below] = -1.0
    return row


def stiffness(built: Assembled, row: Array) -> float:
    """1 / (l K^-1 l^T), N/m: a pair of forces along the drift over the drift; in a shear building the storey stiffness."""
    return float(1.0 / (row @ np.linalg.solve(built.stiffness, row)))


def stiffened(built: Assembled, added: Array) -> Assembled:
    """The structure with the elastic stiffness `added` (n, n; N/m) beside its members."""
    return built._replace(stiffness=built.stiffness + added, elastic=built.elastic + added)
