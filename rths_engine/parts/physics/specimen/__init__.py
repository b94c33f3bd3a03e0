"""Left-out effects of a specimen."""

from typing import Annotated

from pydantic import Field

from rths_engine.parts.physics.specimen.added_inertia import AddedInertia
from rths_engine.parts.physics.specimen.asymmetry import Asymmetry
from rths_engine.parts.physics.specimen.backlash import Backlash
from rths_engine.parts.physics.specimen.bouc_wen_hysteresis import BoucWenHysteresis
from rths_engine.parts.physics.specimen.coulomb_friction import CoulombFriction
from rths_engine.parts.physics.specimen.cubic_stiffness import CubicStiffness
from rths_engine.parts.physics.specimen.current_lag import CurrentLag
from rths_engine.parts.physics.specimen.parallel_stiffness import ParallelStiffness
from rths_engine.parts.physics.specimen.pinching import Pinching
from rths_engine.parts.physics.specimen.series_compliance import SeriesCompliance
from rths_engine.parts.physics.specimen.strength_drop import StrengthDrop
from rths_engine.parts.physics.specimen.stribeck_friction import StribeckFriction
from rths_engine.parts.physics.specimen.velocity_exponent import VelocityExponent
from rths_engine.parts.physics.specimen.viscous_heating import ViscousHeating

KINDS = (
    CoulombFriction,
    StribeckFriction,
    Backlash,
    ViscousHeating,
    SeriesCompliance,
    ParallelStiffness,
    CubicStiffness,
    AddedInertia,
    Asymmetry,
    VelocityExponent,
    BoucWenHysteresis,
    Pinching,
    StrengthDrop,
    CurrentLag,
)
SpecimenEffect = Annotated[
    CoulombFriction
    | StribeckFriction
    | Backlash
    | ViscousHeating
    | SeriesCompliance
    | ParallelStiffness
    | CubicStiffness
    | AddedInertia
    | Asymmetry
    | VelocityExponent
    | BoucWenHysteresis
    | Pinching
    | StrengthDrop
    | CurrentLag,
    Field(discriminator="kind"),
]
