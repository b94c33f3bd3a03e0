"""A Bouc-Wen element between two floors."""

from __future__ import annotations

from typing import ClassVar

from rths_engine.parts.physics.effect import STOREY
from rths_engine.parts.physics.specimen import bouc_wen_hysteresis as specimen
from rths_engine.parts.physics.structure.storey import OfStorey, StoreySearch


class BoucWenHysteresis(OfStorey, specimen.BoucWenHysteresis):
    """A Bouc-Wen element between two floors.

    f = F zeta,  x_y zeta' = v (1 - |zeta|^n (eta sgn(v zeta) + 1 - eta))

    x is the drift of the storey. The other symbols are those of `physics.specimen.bouc_wen_hysteresis`.
    """

    title: ClassVar[str] = "Bouc-Wen hysteresis of a storey"
    hook: ClassVar[int] = STOREY


class BoucWenHysteresisSearch(StoreySearch[BoucWenHysteresis], specimen.BoucWenHysteresisSearch[BoucWenHysteresis]):
    relatives = ("coulomb_friction", "yielding")
    noun = "hysteresis"
