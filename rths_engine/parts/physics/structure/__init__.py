"""Left-out effects of a structure."""

from typing import Annotated

from pydantic import Field

from rths_engine.parts.physics.structure.base_flexibility import BaseFlexibility
from rths_engine.parts.physics.structure.bouc_wen_hysteresis import BoucWenHysteresis
from rths_engine.parts.physics.structure.coulomb_friction import CoulombFriction
from rths_engine.parts.physics.structure.cubic_stiffness import CubicStiffness
from rths_engine.parts.physics.structure.damping_error import DampingError
from rths_engine.parts.physics.structure.gap_contact import GapContact
from rths_engine.parts.physics.structure.mass_error import MassError
from rths_engine.parts.physics.structure.p_delta import PDelta
from rths_engine.parts.physics.structure.pinching import Pinching
from rths_engine.parts.physics.structure.quadratic_damping import QuadraticDamping
from rths_engine.parts.physics.structure.stiffness_drop import StiffnessDrop
from rths_engine.parts.physics.structure.stiffness_error import StiffnessError
from rths_engine.parts.physics.structure.yielding import Yielding

KINDS = (
    StiffnessError,
    MassError,
    DampingError,
    CoulombFriction,
    QuadraticDamping,
    CubicStiffness,
    Yielding,
    BoucWenHysteresis,
    Pinching,
    GapContact,
    PDelta,
    BaseFlexibility,
    StiffnessDrop,
)
StructureEffect = Annotated[
    StiffnessError
    | MassError
    | DampingError
    | CoulombFriction
    | QuadraticDamping
    | CubicStiffness
    | Yielding
    | BoucWenHysteresis
    | Pinching
    | GapContact
    | PDelta
    | BaseFlexibility
    | StiffnessDrop,
    Field(discriminator="kind"),
]
