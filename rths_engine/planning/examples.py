"""Example plans for every kind of test: a damper, an actuator or a structure alone, and a first hybrid test."""

from __future__ import annotations

from collections.abc import Callable

from rths_engine.foundation.units import STANDARD_GRAVITY
from rths_engine.parts.actuators.first_order_delay import FirstOrderDelay
from rths_engine.parts.actuators.servo_hydraulic import ServoHydraulicActuator
from rths_engine.parts.compensators.inverse import InverseCompensation
from rths_engine.parts.compensators.none import NoCompensation
from rths_engine.parts.controllers.clipped_optimal import ClippedOptimal
from rths_engine.parts.ground_motions.scaling import ToPga
from rths_engine.parts.integrators.kr_alpha import KrAlphaIntegrator
from rths_engine.parts.integrators.newmark import ExplicitNewmark
from rths_engine.parts.specimens.linear import LinearSpecimen
from rths_engine.parts.specimens.mr_damper import MrDamper
from rths_engine.parts.specimens.mr_damper_current import MrDamperCurrent
from rths_engine.parts.structures.matrices import MatricesStructure
from rths_engine.parts.structures.moment_frame import FrameStorey, MomentFrame
from rths_engine.parts.structures.shear_building import ShearBuilding, Storey
from rths_engine.planning.eccentric_floor import eccentric_floor
from rths_engine.planning.excitation import Drive, FloorForce, Start
from rths_engine.planning.motion import RecordMotion
from rths_engine.planning.plan import Noise, Plan, RealTime, Station
from rths_engine.planning.safety import Limits
from rths_engine.planning.shapes import Chirp, IncreasingCycles, Sine
from rths_engine.planning.two_storeys import two_storeys

# chosen; see docs/decisions/0023
EL_CENTRO = "imperial-valley-1940-el-centro-ns"
SENSORS = Noise(displacement=10e-6, force=200.0)


def linear_damper(name: str) -> Plan:
    """A one-storey building with a linear viscous damper."""
    return Plan(
        name="Linear viscous damper in a one-storey building",
        notes="A first test with one station and a linear specimen. The inverse compensation matches the actuator.",
        template=name,
        motion=RecordMotion(record=EL_CENTRO, scale=ToPga(pga=0.15 * STANDARD_GRAVITY)),
        structure=ShearBuilding(storeys=(Storey(mass=2.0e5, stiffness=8.0e6, height=3.5),), damping_ratio=0.02),
        stations=(
            Station(
                name="Damper",
                storey=1,
                compensator=InverseCompensation(alpha_es=20.0),
                actuator=FirstOrderDelay(alpha=20.0),
                specimen=LinearSpecimen(stiffness=0.0, damping=3.0e5),
                equivalent_damping=3.0e5,
            ),
        ),
        pace=RealTime(factor=4.0),
    )


def semi_active(name: str) -> Plan:
    """A one-storey building with an MR damper whose current a controller switches."""
    damper = Station(
        name="MR damper",
        storey=1,
        compensator=InverseCompensation(alpha_es=20.0),
        actuator=FirstOrderDelay(alpha=20.0),
        specimen=MrDamperCurrent(),
        controller=ClippedOptimal(velocity_gain=1.0e6, largest_current=2.5),
        equivalent_damping=3.0e5,
        noise=SENSORS,
    )
    return linear_damper(name).model_copy(
        update={
            "name": "Semi-active MR damper in a one-storey building",
            "notes": "The controller applies 2.5 A while the damper force is smaller than 1000 kN·s/m times the damper "
            "velocity, else no current. Compare with a constant current of 0 A and of 2.5 A: the storey drift lies between "
            "theirs, and the absolute acceleration of the floor is below both.",
            "stations": (damper,),
            "seed": 1,
        }
    )


def specimen_mr_damper(name: str) -> Plan:
    """An MR damper alone, driven by a prescribed displacement."""
    damper = Station(
        name="MR damper",
        compensator=NoCompensation(),
        actuator=FirstOrderDelay(alpha=1.0),
        specimen=MrDamper(),
        noise=SENSORS,
        limits=Limits(displacement=0.08, velocity=0.2, force=3.0e5),
    )
    return Plan(
        name="MR damper, cycles of increasing amplitude",
        notes="Characterisation before a hybrid test: three cycles at each of 10, 20, 30, 40 and 50 mm, at 0.25 Hz. The "
        "actuator has no delay.",
        template=name,
        test="specimen",
        drive=Drive(amplitude=0.05, shape=IncreasingCycles(frequency=0.25, levels=(0.2, 0.4, 0.6, 0.8, 1.0), cycles_each=3)),
        stations=(damper,),
        seed=1,
    )


def actuator_sweep(name: str) -> Plan:
    """A servo-hydraulic actuator alone, under a sweep."""
    actuator = Station(
        name="Servo-hydraulic actuator",
        compensator=NoCompensation(),
        actuator=ServoHydraulicActuator(),
        specimen=LinearSpecimen(stiffness=2.0e6, damping=5.0e4),
        noise=SENSORS,
        limits=Limits(displacement=0.05, velocity=0.4, force=1.0e6),
    )
    return Plan(
        name="Actuator tracking a sweep from 0.1 to 10 Hz",
        notes="Delay and amplitude of the actuator against frequency, with a spring of 2 kN/mm and without compensation.",
        template=name,
        test="actuator",
        drive=Drive(amplitude=0.005, shape=Chirp(start_frequency=0.1, end_frequency=10.0, duration=40.0)),
        stations=(actuator,),
        seed=1,
    )


def structure_earthquake(name: str) -> Plan:
    """A moment frame alone under an earthquake."""
    sections = ((4.57, "W24x55"), (3.96, "W18x40"))
    storeys = tuple(FrameStorey(height=h, mass=662.9e3, column="W14x120", beam=beam) for h, beam in sections)
    return Plan(
        name="Moment frame without dampers under Northridge",
        notes="The steel frame of Chen and Ricles (2012) without dampers, to compare with tests of dampers. Its members yield.",
        template=name,
        test="structure",
        motion=RecordMotion(record="northridge-1994-beverly-hills-009"),
        structure=MomentFrame(bays=(9.15,) * 4, storeys=storeys),
        duration=30.0,
    )


def structure_free_vibration(name: str) -> Plan:
    """A three-storey building that is pulled and then released."""
    storeys = tuple(Storey(mass=5.0e4, stiffness=k, height=3.2) for k in (4.0e7, 3.2e7, 2.4e7))
    return Plan(
        name="Pull and release of a three-storey building",
        notes="A cable pulls the roof by 30 mm and releases the roof. The decay gives period and damping of the first mode.",
        template=name,
        test="structure",
        start=Start(displacement=_pulled_at_the_top(storeys, 0.03)),
        structure=ShearBuilding(storeys=storeys, damping_ratio=0.02),
        integrator=ExplicitNewmark(),
        duration=20.0,
    )


def structure_matrices(name: str) -> Plan:
    """A structure given by its matrices, with a shaker on its roof."""
    mass = ((5.0e4, 0.0, 0.0), (0.0, 5.0e4, 0.0), (0.0, 0.0, 4.0e4))
    stiffness = ((7.2e7, -3.2e7, 0.0), (-3.2e7, 5.6e7, -2.4e7), (0.0, -2.4e7, 2.4e7))
    damping = ((1.3e5, -4.0e4, 0.0), (-4.0e4, 1.1e5, -3.0e4), (0.0, -3.0e4, 6.0e4))
    return Plan(
        name="Structure given by M, C and K with a shaker on its roof",
        notes="Three degrees of freedom from another program. A harmonic force near the first mode causes resonance.",
        template=name,
        test="structure",
        forces=(FloorForce(floor=3, amplitude=2.0e4, shape=Sine(frequency=2.0, cycles=60, ramps=2)),),
        structure=MatricesStructure(mass=mass, stiffness=stiffness, damping=damping),
        integrator=KrAlphaIntegrator(),
        duration=40.0,
    )


def _pulled_at_the_top(storeys: tuple[Storey, ...], top: float) -> tuple[float, ...]:
    """Displacements (m) under one force at the top, which every storey carries: x_j = top sum_(i<=j) 1/k_i / sum_i 1/k_i."""
    flexibility = [sum(1 / storey.stiffness for storey in storeys[: j + 1]) for j in range(len(storeys))]
    return tuple(top * one / flexibility[-1] for one in flexibility)


def opensees_client(name: str) -> Plan:
    """A damper that follows a structure in OpenSees."""
    damper = Station(
        name="Damper",
        compensator=InverseCompensation(alpha_es=20.0),
        actuator=FirstOrderDelay(alpha=20.0),
        specimen=LinearSpecimen(stiffness=2.0e6, damping=5.0e4),
        equivalent_stiffness=2.0e6,
        noise=SENSORS,
    )
    return Plan(
        name="Damper under a structure in OpenSees",
        notes="OpenSees computes the structure and sends the displacements of its element genericClient. The rig follows and "
        "answers the measured forces. The page of the test shows the line for the script.",
        template=name,
        test="client",
        controller_rate=1000.0,
        stations=(damper,),
        seed=1,
        pace=RealTime(),
    )


EXAMPLES: dict[str, Callable[[str], Plan]] = {
    "linear-damper": linear_damper,
    "two-storeys": two_storeys,
    "semi-active": semi_active,
    "two-actuators": eccentric_floor,
    "specimen-mr-damper": specimen_mr_damper,
    "actuator-sweep": actuator_sweep,
    "structure-earthquake": structure_earthquake,
    "structure-free-vibration": structure_free_vibration,
    "structure-matrices": structure_matrices,
    "opensees-client": opensees_client,
}
