"""Left-out effects of an actuator."""

from typing import TYPE_CHECKING, Any

from rths_engine.parts.physics.actuator.amplitude_dependent_delay import AmplitudeDependentDelay, AmplitudeDependentDelaySearch
from rths_engine.parts.physics.actuator.backlash import Backlash, BacklashSearch
from rths_engine.parts.physics.actuator.dead_band import DeadBand, DeadBandSearch
from rths_engine.parts.physics.actuator.delay_error import DelayError, DelayErrorSearch
from rths_engine.parts.physics.actuator.force_compliance import ForceCompliance, ForceComplianceSearch
from rths_engine.parts.physics.actuator.gain_error import GainError, GainErrorSearch
from rths_engine.parts.physics.actuator.second_order_lag import SecondOrderLag, SecondOrderLagSearch
from rths_engine.parts.physics.actuator.stick_friction import StickFriction, StickFrictionSearch
from rths_engine.parts.physics.actuator.supply_saturation import SupplySaturation, SupplySaturationSearch
from rths_engine.parts.physics.actuator.valve_flow import ValveFlow, ValveFlowSearch
from rths_engine.parts.physics.actuator.velocity_saturation import VelocitySaturation, VelocitySaturationSearch
from rths_engine.parts.physics.effect import Effect
from rths_engine.parts.physics.registry import laws, union
from rths_engine.parts.physics.search import Search

SEARCHES: tuple[Search[Any], ...] = (
    DelayErrorSearch(DelayError),
    AmplitudeDependentDelaySearch(AmplitudeDependentDelay),
    SecondOrderLagSearch(SecondOrderLag),
    VelocitySaturationSearch(VelocitySaturation),
    ForceComplianceSearch(ForceCompliance),
    DeadBandSearch(DeadBand),
    BacklashSearch(Backlash),
    StickFrictionSearch(StickFriction),
    GainErrorSearch(GainError),
    ValveFlowSearch(ValveFlow),
    SupplySaturationSearch(SupplySaturation),
)
KINDS = laws(SEARCHES)
if TYPE_CHECKING:
    ActuatorEffect = Effect
else:
    ActuatorEffect = union(KINDS)
