"""Left-out effects of a structure."""

from typing import TYPE_CHECKING, Any

from rths_engine.parts.physics.effect import Effect
from rths_engine.parts.physics.registry import laws, union
from rths_engine.parts.physics.search import Search
from rths_engine.parts.physics.structure.base_flexibility import BaseFlexibility, BaseFlexibilitySearch
from rths_engine.parts.physics.structure.bouc_wen_hysteresis import BoucWenHysteresis, BoucWenHysteresisSearch
from rths_engine.parts.physics.structure.coulomb_friction import CoulombFriction, CoulombFrictionSearch
from rths_engine.parts.physics.structure.cubic_stiffness import CubicStiffness, CubicStiffnessSearch
from rths_engine.parts.physics.structure.damping_error import DampingError, DampingErrorSearch
from rths_engine.parts.physics.structure.gap_contact import GapContact, GapContactSearch
from rths_engine.parts.physics.structure.mass_error import MassError, MassErrorSearch
from rths_engine.parts.physics.structure.p_delta import PDelta, PDeltaSearch
from rths_engine.parts.physics.structure.pinching import Pinching, PinchingSearch
from rths_engine.parts.physics.structure.quadratic_damping import QuadraticDamping, QuadraticDampingSearch
from rths_engine.parts.physics.structure.self_centring import SelfCentring, SelfCentringSearch
from rths_engine.parts.physics.structure.softening import Softening, SofteningSearch
from rths_engine.parts.physics.structure.stiffness_degradation import StiffnessDegradation, StiffnessDegradationSearch
from rths_engine.parts.physics.structure.stiffness_drop import StiffnessDrop, StiffnessDropSearch
from rths_engine.parts.physics.structure.stiffness_error import StiffnessError, StiffnessErrorSearch
from rths_engine.parts.physics.structure.yielding import Yielding, YieldingSearch

SEARCHES: tuple[Search[Any], ...] = (
    StiffnessErrorSearch(StiffnessError),
    MassErrorSearch(MassError),
    DampingErrorSearch(DampingError),
    CoulombFrictionSearch(CoulombFriction),
    QuadraticDampingSearch(QuadraticDamping),
    CubicStiffnessSearch(CubicStiffness),
    YieldingSearch(Yielding),
    BoucWenHysteresisSearch(BoucWenHysteresis),
    PinchingSearch(Pinching),
    GapContactSearch(GapContact),
    PDeltaSearch(PDelta),
    BaseFlexibilitySearch(BaseFlexibility),
    StiffnessDropSearch(StiffnessDrop),
    SofteningSearch(Softening),
    StiffnessDegradationSearch(StiffnessDegradation),
    SelfCentringSearch(SelfCentring),
)
KINDS = laws(SEARCHES)
if TYPE_CHECKING:
    StructureEffect = Effect
else:
    StructureEffect = union(KINDS)
