"""A floor in plan, tested by two parallel actuators on one loading beam: translation and rotation.

The structure is one floor of an eccentric building, with the degrees of freedom translation (m) and rotation (rad). The tested
part, dampers and bearings at different places below the floor, is one specimen. It couples both motions, and both actuators.
"""

from __future__ import annotations

import math

from rths_engine.foundation.units import STANDARD_GRAVITY
from rths_engine.parts.actuators.servo_hydraulic import ServoHydraulicActuator
from rths_engine.parts.compensators.inverse import InverseCompensation
from rths_engine.parts.ground_motions.scaling import ToPga
from rths_engine.parts.specimens.bouc_wen import BoucWen
from rths_engine.parts.specimens.elastomeric import Elastomeric
from rths_engine.parts.specimens.no_specimen import NoSpecimen
from rths_engine.parts.structures.matrices import MatricesStructure
from rths_engine.planning.coupling import Attached, LoadingBeam
from rths_engine.planning.motion import RecordMotion
from rths_engine.planning.plan import Noise, Plan, Station
from rths_engine.planning.safety import Limits

# chosen; see docs/decisions/0023
MASS, GYRATION = 200e3, 3.5  # kg and m, of the floor
PERIODS = (0.9, 0.7)  # s, of translation and of rotation without the specimen
DAMPING = 0.02
SPACING = 4.0  # m, of the actuators
BEARING = Elastomeric(stiffness=1.0e6, branch_stiffnesses=(1.0e6,), relaxation_times=(0.1,))
DELAY = 30.0  # controller steps: T / dt of the actuator


def eccentric_floor(name: str) -> Plan:
    """Two actuators on one loading beam: a floor that translates and rotates."""
    inertia = MASS * GYRATION**2
    stiffness = tuple(own * (2 * math.pi / period) ** 2 for own, period in zip((MASS, inertia), PERIODS, strict=True))
    return Plan(
        name="Eccentric floor on one loading beam",
        notes="Two parallel actuators move one rigid loading beam. A yielding damper on one side and a bearing on the other "
        "make the specimen eccentric, so that the floor rotates although the ground only translates.",
        template=name,
        motion=RecordMotion(record="imperial-valley-1940-el-centro-ns", scale=ToPga(pga=0.2 * STANDARD_GRAVITY)),
        structure=MatricesStructure(
            mass=((MASS, 0.0), (0.0, inertia)),
            stiffness=((stiffness[0], 0.0), (0.0, stiffness[1])),
            damping_ratio=DAMPING,
            floors=(1,),
            drifts=((1.0, -SPACING / 2), (1.0, SPACING / 2)),
        ),
        stations=(_station(1, "Left actuator"), _station(2, "Right actuator")),
        couplings=(
            LoadingBeam(
                name="Bearing and damper",
                spacing=SPACING,
                stiffness=2.0e6,
                rotational_stiffness=4.0e6,
                damping=4.0e4,
                rotational_damping=8.0e4,
                mass=800.0,
                rotary_inertia=1000.0,
                specimens=(
                    Attached(position=1.5, specimen=BoucWen(stiffness=2.0e7, yield_force=1.5e5)),
                    Attached(position=-1.5, specimen=BEARING),
                ),
            ),
        ),
        duration=30.0,
    )


def _station(row: int, name: str) -> Station:
    return Station(
        name=name,
        storey=row,
        compensator=InverseCompensation(alpha_es=DELAY),
        actuator=ServoHydraulicActuator(),
        specimen=NoSpecimen(),
        noise=Noise(displacement=10e-6, force=200.0),
        limits=Limits(displacement=0.2, velocity=0.56, force=1.0e6),
    )
