"""Semi-active controllers: `step(p, s, d, v, f, dt) -> current` (m, m/s, N, A) of one damper.

`d` and `v` are the command displacement of the station and its velocity, `f` the measured force of the last substep.
"""

from typing import Annotated

from pydantic import Field

from rths_engine.foundation.part import kinds
from rths_engine.parts.controllers.clipped_optimal import ClippedOptimal
from rths_engine.parts.controllers.constant_current import ConstantCurrent
from rths_engine.parts.controllers.no_control import NoControl
from rths_engine.parts.controllers.on_off import OnOff

Controller = Annotated[NoControl | ConstantCurrent | OnOff | ClippedOptimal, Field(discriminator="kind")]
KINDS = kinds(Controller)
