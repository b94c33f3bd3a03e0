"""Delay compensators: `step(p, s, x_cmd, x_cmd_last, x_meas, ti, dt) -> x_comp`, all in m, m^2 and s.

`x_meas` and `ti` are of the last substep; s[0] is the recorded d_alpha.
"""

from typing import Annotated

from pydantic import Field

from rths_engine.compensators.aic import AdaptiveInverseCompensation
from rths_engine.compensators.inverse import InverseCompensation
from rths_engine.compensators.none import NoCompensation

KINDS = (NoCompensation, InverseCompensation, AdaptiveInverseCompensation)
Compensator = Annotated[NoCompensation | InverseCompensation | AdaptiveInverseCompensation, Field(discriminator="kind")]
