"""A two-storey shear building with MR dampers, of about the size of the frame of Chen and Ricles (2012), EESD 41, 549-569.

It has the storey stiffnesses, the first period and the damping of the frame, and first-order delays as actuators. It is a small
hybrid test with two stations; the frame itself with the emulated laboratory is in the templates of Table III.
"""

from __future__ import annotations

import math

from rths_engine.parts.actuators.first_order_delay import FirstOrderDelay
from rths_engine.parts.compensators.aic import AdaptiveInverseCompensation
from rths_engine.parts.ground_motions.scaling import Factor
from rths_engine.parts.specimens.mr_damper import MrDamper
from rths_engine.parts.structures.shear_building import ShearBuilding, Storey
from rths_engine.planning.motion import RecordMotion
from rths_engine.planning.paper import DAMPERS, FORCE_CAPACITY, HEIGHTS, VELOCITY_CAPACITY
from rths_engine.planning.plan import Noise, Plan, Station

# Chen and Ricles (2012); the last two, chosen for it: docs/decisions/0013
STOREY_STIFFNESS = (36_007e3, 23_894e3)  # N/m
FIRST_PERIOD = 1.48  # s
ACTUATOR_ALPHA = (30.0, 45.0)
ESTIMATED_ALPHA = 30.0  # of both stations, as in simulation 4 of Table III
ADAPTATION = 0.4e6  # 1/m^2, as in simulation 4 of Table III
BRACE_STIFFNESS = 4e8  # N/m, lateral, of all braces of a storey: docs/decisions/0013
NORTHRIDGE = RecordMotion(record="northridge-1994-beverly-hills-009", scale=Factor(factor=0.6))


def two_storeys(name: str) -> Plan:
    """MR dampers in a two-storey shear building, with adaptive compensation of two different delays."""
    return Plan(
        name="MR dampers in a two-storey shear building",
        notes="Two stations with first-order delays of 30 and 45 controller steps. Both estimates are 30 steps: that "
        "of the second is wrong, and its compensator adapts.",
        template=name,
        motion=NORTHRIDGE,
        structure=_building(),
        stations=(_station(0), _station(1)),
        seed=4,
        duration=40.0,
    )


def _station(j: int) -> Station:
    actuator = FirstOrderDelay(alpha=ACTUATOR_ALPHA[j], force_limit=FORCE_CAPACITY[j], velocity_limit=VELOCITY_CAPACITY[j])
    return Station(
        name=f"Storey {j + 1} damper",
        storey=j + 1,
        dampers=DAMPERS[j],
        compensator=AdaptiveInverseCompensation(alpha_es=ESTIMATED_ALPHA, kp=ADAPTATION, ki=ADAPTATION / 10),
        actuator=actuator,
        specimen=MrDamper(stiffness=_with_brace(MrDamper().stiffness, DAMPERS[j])),
        noise=Noise(displacement=10e-6, force=200.0),
    )


def _with_brace(stiffness: float, dampers: int) -> float:
    """The spring of one damper in series with its share of the braces, which are no degree of freedom of the shear building."""
    return 1 / (1 / stiffness + dampers / BRACE_STIFFNESS)


def _building() -> ShearBuilding:
    """The building with equal floor masses for the paper's T1: m = lambda (T1 / 2 pi)^2, lambda the lower root for m = 1."""
    k1, k2 = STOREY_STIFFNESS
    root = ((k1 + 2 * k2) - math.sqrt((k1 + 2 * k2) ** 2 - 4 * k1 * k2)) / 2
    mass = root * (FIRST_PERIOD / (2 * math.pi)) ** 2
    storeys = tuple(Storey(mass=mass, stiffness=k, height=h) for k, h in zip(STOREY_STIFFNESS, HEIGHTS, strict=True))
    return ShearBuilding(storeys=storeys, damping_ratio=0.02)
