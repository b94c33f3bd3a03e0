"""Left-out effects of an actuator."""

from typing import Annotated

from pydantic import Field

from rths_engine.parts.physics.actuator.amplitude_dependent_delay import AmplitudeDependentDelay
from rths_engine.parts.physics.actuator.backlash import Backlash
from rths_engine.parts.physics.actuator.dead_band import DeadBand
from rths_engine.parts.physics.actuator.delay_error import DelayError
from rths_engine.parts.physics.actuator.force_compliance import ForceCompliance
from rths_engine.parts.physics.actuator.gain_error import GainError
from rths_engine.parts.physics.actuator.second_order_lag import SecondOrderLag
from rths_engine.parts.physics.actuator.stick_friction import StickFriction
from rths_engine.parts.physics.actuator.velocity_saturation import VelocitySaturation

KINDS = (
    DelayError,
    AmplitudeDependentDelay,
    SecondOrderLag,
    VelocitySaturation,
    ForceCompliance,
    DeadBand,
    Backlash,
    StickFriction,
    GainError,
)
ActuatorEffect = Annotated[
    DelayError
    | AmplitudeDependentDelay
    | SecondOrderLag
    | VelocitySaturation
    | ForceCompliance
    | DeadBand
    | Backlash
    | StickFriction
    | GainError,
    Field(discriminator="kind"),
]
