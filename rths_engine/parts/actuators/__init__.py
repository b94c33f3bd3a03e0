"""Actuators: `step(p, s, x_comp, force) -> displacement` (m, N).

`force` is the force of the specimen at the last substep. The command x_comp is a displacement (m), or the quantity that drives
this kind of actuator.

Each actuator has a `velocity_limit` (m/s) and a `force_limit` (N), its largest velocity and force.
"""

from typing import Annotated

from pydantic import Field

from rths_engine.foundation.part import kinds
from rths_engine.parts.actuators.first_order_delay import FirstOrderDelay
from rths_engine.parts.actuators.interacting import InteractingActuator
from rths_engine.parts.actuators.second_order import SecondOrderActuator
from rths_engine.parts.actuators.servo_hydraulic import ServoHydraulicActuator
from rths_engine.parts.actuators.velocity_drive import VelocityDrive

Actuator = Annotated[
    FirstOrderDelay | SecondOrderActuator | ServoHydraulicActuator | VelocityDrive | InteractingActuator,
    Field(discriminator="kind"),
]
KINDS = kinds(Actuator)
