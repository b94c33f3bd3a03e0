"""Coulomb friction between two floors."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar

from rths_engine.parts.physics.effect import STOREY
from rths_engine.parts.physics.search import Seen
from rths_engine.parts.physics.specimen import coulomb_friction as specimen
from rths_engine.parts.physics.structure.storey import OfStorey, StoreySearch


class CoulombFriction(OfStorey, specimen.CoulombFriction):
    """Coulomb friction between two floors.

    f = F_c z,  x_e z' = v - |v| z

    x is the drift of the storey. Bolts, partitions or bearings rub between its floors. The other symbols are those of
    `physics.specimen.coulomb_friction`.
    """

    title: ClassVar[str] = "Coulomb friction of a storey"
    hook: ClassVar[int] = STOREY


class CoulombFrictionSearch(StoreySearch[CoulombFriction], specimen.CoulombFrictionSearch[CoulombFriction]):
    relatives = ("bouc_wen_hysteresis", "damping_error", "quadratic_damping")
    noun = "Coulomb friction"

    def guesses(self, seen: Seen) -> Iterator[CoulombFriction]:
        """Two sizes: a free vibration stops after f / F_c quarters of a cycle, so a small friction looks different."""
        for share in (0.01, 0.1):
            guess = self.sized(friction=share * seen.f, presliding=0.01 * seen.x)
            yield guess.model_copy(update={"storey": seen.storey})
