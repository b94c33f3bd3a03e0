"""Left-out effects of a specimen."""

from typing import TYPE_CHECKING, Any

from rths_engine.parts.physics.effect import Effect
from rths_engine.parts.physics.registry import laws, union
from rths_engine.parts.physics.search import Search
from rths_engine.parts.physics.specimen.added_inertia import AddedInertia, AddedInertiaSearch
from rths_engine.parts.physics.specimen.asymmetric_viscosity import AsymmetricViscosity, AsymmetricViscositySearch
from rths_engine.parts.physics.specimen.asymmetry import Asymmetry, AsymmetrySearch
from rths_engine.parts.physics.specimen.backlash import Backlash, BacklashSearch
from rths_engine.parts.physics.specimen.bouc_wen_hysteresis import BoucWenHysteresis, BoucWenHysteresisSearch
from rths_engine.parts.physics.specimen.coulomb_friction import CoulombFriction, CoulombFrictionSearch
from rths_engine.parts.physics.specimen.cubic_stiffness import CubicStiffness, CubicStiffnessSearch
from rths_engine.parts.physics.specimen.current_lag import CurrentLag, CurrentLagSearch
from rths_engine.parts.physics.specimen.gap_contact import GapContact, GapContactSearch
from rths_engine.parts.physics.specimen.parallel_stiffness import ParallelStiffness, ParallelStiffnessSearch
from rths_engine.parts.physics.specimen.peak_degradation import PeakDegradation, PeakDegradationSearch
from rths_engine.parts.physics.specimen.pendulum_friction import PendulumFriction, PendulumFrictionSearch
from rths_engine.parts.physics.specimen.pinching import Pinching, PinchingSearch
from rths_engine.parts.physics.specimen.residual_field import ResidualField, ResidualFieldSearch
from rths_engine.parts.physics.specimen.self_centring import SelfCentring, SelfCentringSearch
from rths_engine.parts.physics.specimen.series_compliance import SeriesCompliance, SeriesComplianceSearch
from rths_engine.parts.physics.specimen.stick_slip import StickSlip, StickSlipSearch
from rths_engine.parts.physics.specimen.stiffness_degradation import StiffnessDegradation, StiffnessDegradationSearch
from rths_engine.parts.physics.specimen.strength_against_current import (
    StrengthAgainstCurrent,
    StrengthAgainstCurrentSearch,
)
from rths_engine.parts.physics.specimen.strength_against_temperature import (
    StrengthAgainstTemperature,
    StrengthAgainstTemperatureSearch,
)
from rths_engine.parts.physics.specimen.strength_degradation import StrengthDegradation, StrengthDegradationSearch
from rths_engine.parts.physics.specimen.strength_drop import StrengthDrop, StrengthDropSearch
from rths_engine.parts.physics.specimen.stribeck_friction import StribeckFriction, StribeckFrictionSearch
from rths_engine.parts.physics.specimen.velocity_exponent import VelocityExponent, VelocityExponentSearch
from rths_engine.parts.physics.specimen.viscous_heating import ViscousHeating, ViscousHeatingSearch

SEARCHES: tuple[Search[Any], ...] = (
    CoulombFrictionSearch(CoulombFriction),
    StribeckFrictionSearch(StribeckFriction),
    BacklashSearch(Backlash),
    ViscousHeatingSearch(ViscousHeating),
    SeriesComplianceSearch(SeriesCompliance),
    ParallelStiffnessSearch(ParallelStiffness),
    CubicStiffnessSearch(CubicStiffness),
    AddedInertiaSearch(AddedInertia),
    AsymmetrySearch(Asymmetry),
    VelocityExponentSearch(VelocityExponent),
    BoucWenHysteresisSearch(BoucWenHysteresis),
    PinchingSearch(Pinching),
    StrengthDropSearch(StrengthDrop),
    CurrentLagSearch(CurrentLag),
    StrengthDegradationSearch(StrengthDegradation),
    PeakDegradationSearch(PeakDegradation),
    StiffnessDegradationSearch(StiffnessDegradation),
    SelfCentringSearch(SelfCentring),
    PendulumFrictionSearch(PendulumFriction),
    GapContactSearch(GapContact),
    AsymmetricViscositySearch(AsymmetricViscosity),
    StickSlipSearch(StickSlip),
    StrengthAgainstCurrentSearch(StrengthAgainstCurrent),
    ResidualFieldSearch(ResidualField),
    StrengthAgainstTemperatureSearch(StrengthAgainstTemperature),
)
KINDS = laws(SEARCHES)
if TYPE_CHECKING:
    SpecimenEffect = Effect
else:
    SpecimenEffect = union(KINDS)
