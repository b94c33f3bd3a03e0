"""Left-out effects of the ground motion."""

from typing import Annotated

from pydantic import Field

from rths_engine.parts.physics.input.baseline_drift import BaselineDrift
from rths_engine.parts.physics.input.low_pass import LowPass
from rths_engine.parts.physics.input.scale_error import GroundScaleError
from rths_engine.parts.physics.input.time_shift import TimeShift

KINDS = (
    GroundScaleError,
    TimeShift,
    LowPass,
    BaselineDrift,
)
InputEffect = Annotated[GroundScaleError | TimeShift | LowPass | BaselineDrift, Field(discriminator="kind")]
