"""How a record is scaled: by a factor, to a peak ground acceleration, or to a spectral acceleration at T1."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from rths_engine.foundation.errors import Issue, MotionError
from rths_engine.foundation.part import Value, quantity
from rths_engine.foundation.units import STANDARD_GRAVITY
from rths_engine.parts.ground_motions.record import Motion
from rths_engine.parts.ground_motions.spectrum import spectral_acceleration


class Factor(Value):
    """Multiplies the record by a factor."""

    kind: Literal["factor"] = "factor"
    factor: float = quantity("Scale factor", gt=0, le=100, default=1.0)
    title: ClassVar[str] = "By a factor"

    def factor_for(self, motion: Motion, period: float) -> float:
        return self.factor


class ToPga(Value):
    """Scales the record to a peak ground acceleration."""

    kind: Literal["pga"] = "pga"
    pga: float = quantity(
        "Peak ground acceleration (PGA)", "m/s^2", "g", gt=0, le=5 * STANDARD_GRAVITY, default=0.4 * STANDARD_GRAVITY
    )
    title: ClassVar[str] = "To a peak ground acceleration"

    def factor_for(self, motion: Motion, period: float) -> float:
        return self.pga / _moving(motion.pga, motion)


class ToSpectralAcceleration(Value):
    """Scales the record to a spectral acceleration at the first period T1 of the structure."""

    kind: Literal["sa_t1"] = "sa_t1"
    sa: float = quantity(
        "Spectral acceleration at T1", "m/s^2", "g", gt=0, le=10 * STANDARD_GRAVITY, default=0.4 * STANDARD_GRAVITY
    )
    damping: float = quantity("Damping ratio of the spectrum", "1", "%", ge=0.001, le=0.5, default=0.05)
    title: ClassVar[str] = "To a spectral acceleration at T1"

    def factor_for(self, motion: Motion, period: float) -> float:
        return self.sa / _moving(spectral_acceleration(motion, period, self.damping), motion)


Scale = Annotated[Factor | ToPga | ToSpectralAcceleration, Field(discriminator="kind")]


def _moving(peak: float, motion: Motion) -> float:
    if peak == 0:
        raise MotionError(Issue("motion.scale", f"record '{motion.name}' is zero throughout", fix="scale it by a factor"))
    return peak
