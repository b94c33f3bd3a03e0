"""A storey that hardens or softens with its drift."""

from __future__ import annotations

from typing import ClassVar

from rths_engine.parts.physics.effect import STOREY
from rths_engine.parts.physics.specimen import cubic_stiffness as specimen
from rths_engine.parts.physics.structure.storey import OfStorey
from rths_engine.parts.physics.wording import said


class CubicStiffness(OfStorey, specimen.CubicStiffness):
    """f = k_3 x^3

    x drift of the storey. Else as `physics.specimen.cubic_stiffness`.
    """

    title: ClassVar[str] = "Cubic stiffness of a storey"
    hook: ClassVar[int] = STOREY
    needs: ClassVar = ("x_floor",)
    relatives: ClassVar = ("yielding", "gap_contact", "pinching")
    noun: ClassVar[str] = "cubic stiffness"

    def says(self) -> str:
        return f"{'hardens' if self.stiffness >= 0 else 'softens'} with its drift by {said(abs(self.stiffness), 'kN/m^3')}"
