"""A self-centring element between two floors, with a flag-shaped hysteresis."""

from __future__ import annotations

from typing import ClassVar

from rths_engine.parts.physics.effect import STOREY
from rths_engine.parts.physics.specimen import self_centring as specimen
from rths_engine.parts.physics.structure.storey import OfStorey, StoreySearch


class SelfCentring(OfStorey, specimen.SelfCentring):
    """A self-centring element between two floors, with a flag-shaped hysteresis.

    f = F zeta,  x_a zeta' = v,  min(r, 1 - beta) <= zeta <= min(r, 1),  r = x / x_a >= 0; for x < 0 mirrored

    x is the drift of the storey. The other symbols are those of `physics.specimen.self_centring`.
    """

    title: ClassVar[str] = "Self-centring of a storey"
    hook: ClassVar[int] = STOREY


class SelfCentringSearch(StoreySearch[SelfCentring], specimen.SelfCentringSearch[SelfCentring]):
    relatives = ("softening", "bouc_wen_hysteresis", "yielding", "pinching")
    noun = "self-centring"
