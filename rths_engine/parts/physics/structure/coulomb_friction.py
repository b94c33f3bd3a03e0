"""Coulomb friction between two floors."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar, Self

from rths_engine.parts.physics.effect import STOREY, Seen
from rths_engine.parts.physics.specimen import coulomb_friction as specimen
from rths_engine.parts.physics.structure.storey import OfStorey


class CoulombFriction(OfStorey, specimen.CoulombFriction):
    """f = F_c z,  x_e z' = v - |v| z

    x drift of the storey: bolts, partitions or bearings rub between its floors. Else as `physics.specimen.coulomb_friction`.
    """

    title: ClassVar[str] = "Coulomb friction of a storey"
    hook: ClassVar[int] = STOREY
    needs: ClassVar = ("x_floor",)
    relatives: ClassVar = ("bouc_wen_hysteresis", "damping_error", "quadratic_damping")
    noun: ClassVar[str] = "Coulomb friction"

    @classmethod
    def guesses(cls, seen: Seen) -> Iterator[Self]:
        """A free vibration stops at f / F_c quarters of a cycle: more friction does not look like less."""
        for share in (0.01, 0.1):
            guess = cls.sized(friction=share * seen.f, presliding=0.01 * seen.x)
            yield guess.model_copy(update={"storey": seen.storey})
