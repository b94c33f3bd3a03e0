"""Specimens: `step(p, s, x, dt) -> force` (m, s, N), one damper. A `Commanded` specimen follows a current too."""

from typing import Annotated

from pydantic import Field

from rths_engine.foundation.part import kinds
from rths_engine.parts.specimens.bouc_wen import BoucWen
from rths_engine.parts.specimens.elastomeric import Elastomeric
from rths_engine.parts.specimens.friction_slider import FrictionSlider
from rths_engine.parts.specimens.hyperbolic_tangent import HyperbolicTangent
from rths_engine.parts.specimens.linear import LinearSpecimen
from rths_engine.parts.specimens.linear_with_mass import LinearWithMass
from rths_engine.parts.specimens.mr_damper import MrDamper
from rths_engine.parts.specimens.mr_damper_current import MrDamperCurrent
from rths_engine.parts.specimens.no_specimen import NoSpecimen

Specimen = Annotated[
    LinearSpecimen
    | MrDamper
    | BoucWen
    | HyperbolicTangent
    | FrictionSlider
    | Elastomeric
    | MrDamperCurrent
    | LinearWithMass
    | NoSpecimen,
    Field(discriminator="kind"),
]
KINDS = kinds(Specimen)
