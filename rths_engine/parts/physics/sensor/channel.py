"""The two readings of a station that a sensor effect may be of."""

from __future__ import annotations

import math
from typing import ClassVar, Literal

from pydantic import Field

from rths_engine.parts.physics.effect import F_SENSOR, X_SENSOR, Effect, Seen

CALIBRATED = 2 * math.log(3)  # of BIC: odds of three to one against


class Reading(Effect):
    """y = w: an effect of a sensor, for the displacement and for the force as a kind each, with its own units."""

    shown: ClassVar[str]  # unit of the reading

    def doubt(self, seen: Seen) -> float:
        """An actuator that answers otherwise often reads the same; the sensor was calibrated before the test."""
        return CALIBRATED

    @staticmethod
    def largest(seen: Seen) -> float:
        raise NotImplementedError


class OfDisplacement(Reading):
    """y = x_meas"""

    channel: Literal["x_meas"] = Field("x_meas", title="Channel")
    hook: ClassVar[int] = X_SENSOR
    needs: ClassVar = ("x_meas",)
    shown: ClassVar[str] = "mm"

    @staticmethod
    def largest(seen: Seen) -> float:
        return seen.x


class OfForce(Reading):
    """y = f_meas"""

    channel: Literal["f_meas"] = Field("f_meas", title="Channel")
    hook: ClassVar[int] = F_SENSOR
    needs: ClassVar = ("f_meas",)
    shown: ClassVar[str] = "kN"

    @staticmethod
    def largest(seen: Seen) -> float:
        return seen.f
