"""A storey that hardens or softens with its drift."""

from __future__ import annotations

from typing import ClassVar

from rths_engine.parts.physics.effect import STOREY
from rths_engine.parts.physics.specimen import cubic_stiffness as specimen
from rths_engine.parts.physics.structure.storey import OfStorey, StoreySearch
from rths_engine.parts.physics.wording import said


class CubicStiffness(OfStorey, specimen.CubicStiffness):
    """A storey that hardens or softens with its drift.

    f = k_3 x^3

    x is the drift of the storey. The other symbols are those of `physics.specimen.cubic_stiffness`.
    """

    title: ClassVar[str] = "Cubic stiffness of a storey"
    hook: ClassVar[int] = STOREY


class CubicStiffnessSearch(StoreySearch[CubicStiffness], specimen.CubicStiffnessSearch[CubicStiffness]):
    relatives = ("yielding", "gap_contact", "pinching", "softening")
    noun = "cubic stiffness"

    def says(self, effect: CubicStiffness) -> str:
        return f"{'hardens' if effect.stiffness >= 0 else 'softens'} with its drift by {said(abs(effect.stiffness), 'kN/m^3')}"
