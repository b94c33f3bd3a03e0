"""The test of Chen and Ricles (2012), EESD 41, 549-569, as plans: the 122-DOF frame and an emulated laboratory."""

from __future__ import annotations

from dataclasses import dataclass

from rths_engine.actuators.servo_hydraulic import ServoHydraulicActuator
from rths_engine.compensators import Compensator
from rths_engine.compensators.aic import AdaptiveInverseCompensation
from rths_engine.compensators.inverse import InverseCompensation
from rths_engine.ground_motions.scaling import Factor
from rths_engine.motion import FileMotion, RecordMotion
from rths_engine.plan import Noise, Plan, Station
from rths_engine.specimens.mr_damper import MrDamper
from rths_engine.structures.moment_frame import FrameStorey, MomentFrame
from rths_engine.templates import DAMPERS, FORCE_CAPACITY, PAPER, STOREY_STIFFNESS, VELOCITY_CAPACITY, PaperRow

FLOOR_MASS = 662.9e3  # kg, for T1 = 1.48 s
BAYS = (9.15,) * 4  # m
HEIGHTS = (4.57, 3.96)  # m
BEAMS = ("W24x55", "W18x40")
DURATION = 40.0  # s
PlannedRecord = RecordMotion | FileMotion
BUNDLED = RecordMotion(record="landers-1992-yermo-270", scale=Factor(factor=1.174))


@dataclass(frozen=True, slots=True)
class Laboratory:
    """What is not published of the laboratory (SI), one value a station where there are two. See docs/table4.md."""

    time_constant: tuple[float, float]  # s, of the actuators' position loops
    valve_time: float  # s
    displacement_noise: float  # m, standard deviation
    damper_stiffness: float  # N/m, of the Maxwell element
    brace_ratio: float  # lateral stiffness of a storey's braces over the storey's own
    equivalent_damping: float  # N s/m, of one damper in the integrator's matrix
    force_noise: float = 200.0  # N, standard deviation


LABORATORY = Laboratory(
    time_constant=(27.267e-3, 37.557e-3),
    valve_time=4.7921e-3,
    displacement_noise=99.4e-6,
    damper_stiffness=156.13e6,
    brace_ratio=12.951,
    equivalent_damping=16.41e6,
)


def name(simulation: int) -> str:
    """The template's name of a simulation."""
    return f"table4-{simulation:02d}"


def plans(motion: PlannedRecord, laboratory: Laboratory = LABORATORY) -> dict[int, Plan]:
    """The plan of each of the twelve simulations under a ground motion."""
    return {row.simulation: _plan(row, motion, laboratory) for row in PAPER.values()}


def _plan(row: PaperRow, motion: PlannedRecord, laboratory: Laboratory) -> Plan:
    kp = f", kp = {row.kp:g}" if row.kp else ""
    return Plan(
        name=f"Table IV, simulation {row.simulation} (α_es = {row.alpha_es[0]:g} and {row.alpha_es[1]:g}{kp})",
        notes="After Chen and Ricles (2012), EESD 41, 549-569: the 122-DOF frame with an emulated laboratory.",
        template=name(row.simulation),
        motion=motion,
        structure=_frame(laboratory),
        stations=tuple(_station(j, row, laboratory) for j in range(2)),
        seed=row.simulation,
        duration=DURATION,
    )


def _frame(laboratory: Laboratory) -> MomentFrame:
    storeys = (
        FrameStorey(
            height=height, mass=FLOOR_MASS, column="W14x120", beam=beam, brace_stiffness=laboratory.brace_ratio * stiffness
        )
        for height, beam, stiffness in zip(HEIGHTS, BEAMS, STOREY_STIFFNESS, strict=True)
    )
    return MomentFrame(bays=BAYS, storeys=tuple(storeys))


def _station(j: int, row: PaperRow, laboratory: Laboratory) -> Station:
    return Station(
        name=f"Storey {j + 1} damper",
        storey=j + 1,
        dampers=DAMPERS[j],
        equivalent_damping=laboratory.equivalent_damping,
        compensator=_compensator(row.alpha_es[j], row.kp * 1e6),
        actuator=ServoHydraulicActuator(
            time_constant=laboratory.time_constant[j],
            valve_time=laboratory.valve_time,
            velocity_limit=VELOCITY_CAPACITY[j],
            force_limit=FORCE_CAPACITY[j],
        ),
        specimen=MrDamper(stiffness=laboratory.damper_stiffness),
        noise=Noise(displacement=laboratory.displacement_noise, force=laboratory.force_noise),
    )


def _compensator(alpha_es: float, kp: float) -> Compensator:
    if kp:
        return AdaptiveInverseCompensation(alpha_es=alpha_es, kp=kp, ki=kp / 10)
    return InverseCompensation(alpha_es=alpha_es)
