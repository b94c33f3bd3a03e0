"""Actuators: `step(p, s, x_comp, force) -> displacement` (m, N); `force` is the specimen's at the last substep."""

from typing import Annotated

from pydantic import Field

from rths_engine.actuators.first_order_delay import FirstOrderDelay

KINDS = (FirstOrderDelay,)
Actuator = Annotated[FirstOrderDelay, Field()]
