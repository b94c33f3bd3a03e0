"""The test of Chen and Ricles (2012), EESD 41, 549-569, as plans: the 122-DOF frame and an emulated laboratory."""

from __future__ import annotations

import math
from dataclasses import dataclass

from rths_engine.parts.actuators.servo_hydraulic import ServoHydraulicActuator
from rths_engine.parts.compensators import Compensator
from rths_engine.parts.compensators.aic import AdaptiveInverseCompensation
from rths_engine.parts.compensators.inverse import InverseCompensation
from rths_engine.parts.ground_motions.scaling import Factor
from rths_engine.parts.physics.actuator.amplitude_dependent_delay import AmplitudeDependentDelay
from rths_engine.parts.specimens.mr_damper import MrDamper
from rths_engine.parts.structures.moment_frame import FrameStorey, MomentFrame
from rths_engine.parts.structures.sections import SECTIONS
from rths_engine.planning.motion import FileMotion, RecordMotion
from rths_engine.planning.paper import DAMPERS, FORCE_CAPACITY, HEIGHTS, PAPER, VELOCITY_CAPACITY, PaperRow
from rths_engine.planning.plan import Noise, Plan, Station
from rths_engine.planning.safety import Limits

# Chen and Ricles (2012); each value's source: docs/table4.md
FLOOR_MASS = 662.9e3  # kg, for T1 = 1.48 s
BAYS = (9.15,) * 4  # m
COLUMN = "W14x120"
BEAMS = ("W24x55", "W18x40")
DURATION = 40.0  # s
PlannedRecord = RecordMotion | FileMotion
BUNDLED = RecordMotion(record="landers-1992-yermo-270", scale=Factor(factor=1.174))


# each value's source: docs/table4.md and docs/decisions/0014
STEEL = 200e9  # N/m^2
DAMPER = MrDamper()
VALVE_TIME = 4e-3  # s
COMMON_VELOCITY = 0.1  # m/s, whose secant is a damper's equivalent damping
EQUIVALENT_DAMPING = (DAMPER.yield_force + DAMPER.rate_coefficient * COMMON_VELOCITY**DAMPER.rate_exponent) / COMMON_VELOCITY
GROWTH_MEMORY = 0.5  # s, how long an actuator's delay stays after a large motion
WATCH = Limits(oscillation=10)  # in place of the operator who stopped simulations 7 and 10


@dataclass(frozen=True, slots=True)
class Laboratory:
    """The calibrated numbers of the laboratory (SI); a pair has one value for each station. See docs/table4.md."""

    time_constant: tuple[float, float]  # s, time constants of the actuators' position loops
    delay_growth: float  # s/m, growth of the actuators' delay with the command's amplitude
    displacement_noise: float  # m, standard deviation
    force_noise: float = 200.0  # N, standard deviation, assumed


# calibrated: docs/table4.md
LABORATORY = Laboratory(time_constant=(26.562e-3, 35.396e-3), delay_growth=0.069875, displacement_noise=47e-6)


def name(simulation: int) -> str:
    """The name of the template of a simulation."""
    return f"table3-{simulation:02d}"


def plans(motion: PlannedRecord, laboratory: Laboratory = LABORATORY) -> dict[int, Plan]:
    """The plan of each of the twelve simulations under a ground motion."""
    return {row.simulation: plan(row, motion, laboratory) for row in PAPER.values()}


def plan(row: PaperRow, motion: PlannedRecord, laboratory: Laboratory = LABORATORY) -> Plan:
    """The plan of one simulation under a ground motion."""
    kp = f", kp = {row.kp:g}" if row.kp else ""
    return Plan(
        name=f"Table III, simulation {row.simulation} (α_es = {row.alpha_es[0]:g} and {row.alpha_es[1]:g}{kp})",
        notes="After Chen and Ricles (2012), EESD 41, 549-569: the 122-DOF frame with an emulated laboratory.",
        template=name(row.simulation),
        motion=motion,
        structure=_frame(),
        stations=tuple(_station(j, row, laboratory) for j in range(2)),
        seed=row.simulation,
        duration=DURATION,
    )


def _frame() -> MomentFrame:
    storeys = (
        FrameStorey(
            height=height, mass=FLOOR_MASS, column=COLUMN, beam=beam, brace_stiffness=dampers * _brace_stiffness(height)
        )
        for height, beam, dampers in zip(HEIGHTS, BEAMS, DAMPERS, strict=True)
    )
    return MomentFrame(bays=BAYS, storeys=tuple(storeys))


def _brace_stiffness(height: float) -> float:
    """Lateral stiffness E A cos^2 / l of each damper's brace: a diagonal across one bay with the section of the columns."""
    length = math.hypot(BAYS[0], height)
    return STEEL * SECTIONS[COLUMN].area * BAYS[0] ** 2 / length**3


def _station(j: int, row: PaperRow, laboratory: Laboratory) -> Station:
    return Station(
        name=f"Storey {j + 1} damper",
        storey=j + 1,
        dampers=DAMPERS[j],
        equivalent_damping=EQUIVALENT_DAMPING,
        compensator=_compensator(row.alpha_es[j], row.kp * 1e6),
        actuator=ServoHydraulicActuator(
            time_constant=laboratory.time_constant[j],
            valve_time=VALVE_TIME,
            velocity_limit=VELOCITY_CAPACITY[j],
            force_limit=FORCE_CAPACITY[j],
        ),
        actuator_physics=(AmplitudeDependentDelay(slope=laboratory.delay_growth, memory=GROWTH_MEMORY),),
        specimen=DAMPER,
        limits=WATCH,
        noise=Noise(displacement=laboratory.displacement_noise, force=laboratory.force_noise),
    )


def _compensator(alpha_es: float, kp: float) -> Compensator:
    if kp:
        return AdaptiveInverseCompensation(alpha_es=alpha_es, kp=kp, ki=kp / 10)
    return InverseCompensation(alpha_es=alpha_es)
