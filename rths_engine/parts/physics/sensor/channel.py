"""The two readings of a station, displacement and force, that a sensor effect can change."""

from __future__ import annotations

import math
from typing import ClassVar, Literal, TypeVar

from pydantic import Field

from rths_engine.parts.physics.effect import F_SENSOR, X_SENSOR, Effect
from rths_engine.parts.physics.search import Search, Seen

# chosen; see docs/decisions/0023
CALIBRATED = 2 * math.log(3)  # added to BIC: prior odds 1:3


class Reading(Effect):
    """An effect of a sensor: without the effect y = w. Subclasses exist for displacement and force, each with its own units."""


class OfDisplacement(Reading):
    """An effect on the displacement sensor: y = x_meas."""

    channel: Literal["x_meas"] = Field("x_meas", title="Channel")
    hook: ClassVar[int] = X_SENSOR


class OfForce(Reading):
    """An effect on the load cell: y = f_meas."""

    channel: Literal["f_meas"] = Field("f_meas", title="Channel")
    hook: ClassVar[int] = F_SENSOR


R = TypeVar("R", bound=Reading)


class ReadingSearch(Search[R]):
    """Search for an effect of one reading, which people read in the unit `shown`."""

    def __init__(self, effect: type[R]):
        super().__init__(effect)
        self.needs = (effect.model_fields["channel"].default,)
        self.shown = "mm" if issubclass(effect, OfDisplacement) else "kN"

    def doubt(self, effect: R, seen: Seen) -> float:
        """A constant penalty: an actuator effect often reads the same, and the sensor was calibrated before the test."""
        return CALIBRATED

    def largest(self, seen: Seen) -> float:
        return seen.x if issubclass(self.effect, OfDisplacement) else seen.f
