"""Specimens: `step(p, s, x, dt) -> force` (m, s, N), one damper."""

from typing import Annotated

from pydantic import Field

from rths_engine.specimens.linear import LinearSpecimen
from rths_engine.specimens.mr_damper import MrDamper

KINDS = (LinearSpecimen, MrDamper)
Specimen = Annotated[LinearSpecimen | MrDamper, Field(discriminator="kind")]
