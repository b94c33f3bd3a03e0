"""A drive whose velocity limit is lower than that of its model."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar, Literal

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import Part, quantity
from rths_engine.parts.physics.effect import PART, Effect
from rths_engine.parts.physics.search import Search, Seen
from rths_engine.parts.physics.wording import said


class VelocitySaturation(Effect):
    """A drive whose velocity limit is lower than that of its model.

    |y'| <= v_max

    The velocity limit of the actuator becomes the smaller of the model's limit and v_max (m/s), in both directions. The cause
    is a pump or a valve with less flow than its data sheet. Neutral: v_max = 10 m/s, above the limit of every actuator here.
    Source: Merritt (1967), "Hydraulic Control Systems", Wiley. Not valid where extension and retraction differ.
    """

    kind: Literal["velocity_saturation"] = "velocity_saturation"
    velocity_limit: float = quantity("Velocity limit v_max", "m/s", "mm/s", gt=0, le=10, default=10.0)
    title: ClassVar[str] = "Velocity saturation"
    hook: ClassVar[int] = PART
    neutral: ClassVar = {"velocity_limit": 10.0}

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.zeros(1), np.zeros(1)

    def amended(self, part: Part) -> Part:
        limit = getattr(part, "velocity_limit", None)
        return part if limit is None else part.model_copy(update={"velocity_limit": min(limit, self.velocity_limit)})


class VelocitySaturationSearch(Search[VelocitySaturation]):
    needs = ("x_comp", "x_meas")
    relatives = ("amplitude_dependent_delay", "delay_error", "supply_saturation", "valve_flow")
    noun = "velocity saturation"

    def guesses(self, seen: Seen) -> Iterator[VelocitySaturation]:
        for share in (0.6, 0.8, 0.95):
            yield self.sized(velocity_limit=share * seen.v)

    def says(self, effect: VelocitySaturation) -> str:
        return f"moves no faster than {said(effect.velocity_limit, 'mm/s')}"
