"""The virtual RTHS benchmark of Silva et al. (2020) as plans: four partitioning cases and perturbed plants.

A three-storey frame is tested with one storey in the laboratory. The frame is the whole structure: the analytical
substructure is the frame less the specimen. Its equation of motion keeps the load of the whole mass, because the floor of the
laboratory does not move: M_N a + C_N v + K_N x = -M iota a_g - f.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from scipy.linalg import eigh

from rths_engine.foundation.arrays import Array
from rths_engine.parts.actuators.interacting import InteractingActuator
from rths_engine.parts.compensators import Compensator
from rths_engine.parts.compensators.ats import AdaptiveTimeSeries
from rths_engine.parts.compensators.compensator import TransferSystem
from rths_engine.parts.ground_motions.scaling import Factor
from rths_engine.parts.integrators.newmark import ExplicitNewmark
from rths_engine.parts.specimens.linear_with_mass import LinearWithMass
from rths_engine.parts.structures.matrices import MatricesStructure, Row
from rths_engine.planning.motion import RecordMotion
from rths_engine.planning.plan import Noise, Plan, Station
from rths_engine.planning.safety import Limits

# Silva, Gomez, Maghareh, Dyke and Spencer (2020), with the values of the published files of the benchmark
RATE = 4096.0  # Hz
STIFFNESS = 1e7 * np.array([[2.6055, -2.3134, 0.5937], [-2.3134, 3.2561, -1.4420], [0.5937, -1.4420, 0.9267]])  # N/m
CASES = {1: (1000.0, 0.05), 2: (1100.0, 0.04), 3: (1300.0, 0.03), 4: (1000.0, 0.03)}  # floor mass (kg), damping ratio
SPECIMEN_DAMPING_RATIO = 0.0097
DISPLACEMENT_NOISE = math.sqrt(6.25e-14 * RATE)  # m, of a noise power of 6.25e-14 m^2/Hz
FORCE_NOISE = math.sqrt(1.16e-3 * RATE)  # N
DEVIATION = {"load_stiffness": 5e4, "valve_damping": 3.3, "valve_stiffness": 3.3e3, "leakage": 1.3}  # standard deviations
INTENSITY = 0.4  # of the records
EL_CENTRO = "imperial-valley-1940-el-centro-ns"
# chosen; see docs/decisions/0023
PLANTS_SEED = 2020
MOST_PLANTS = 1000
LIMITS = Limits(displacement=0.05, velocity=0.5, force=8900.0)
# m, m/s: RMS of the first storey in each case
EXPECTED = {1: (0.72e-3, 15.6e-3), 2: (0.77e-3, 15.8e-3), 3: (1.17e-3, 22.3e-3), 4: (0.92e-3, 20.4e-3)}


@dataclass(frozen=True, slots=True)
class Plant:
    """A transfer system with its specimen, nominal or perturbed."""

    actuator: InteractingActuator
    specimen: LinearWithMass


def plant(**changed: float) -> Plant:
    """The nominal plant, or one with `changed` fields of the actuator; the damping ratio of the specimen stays."""
    fields = {"load_stiffness": LinearWithMass().stiffness, **changed}
    mass = LinearWithMass().mass
    damping = 2 * SPECIMEN_DAMPING_RATIO * math.sqrt(mass * fields["load_stiffness"])
    actuator = InteractingActuator(**{**fields, "load_mass": mass, "load_damping": damping})
    return Plant(actuator, LinearWithMass(stiffness=fields["load_stiffness"], damping=damping, mass=mass))


@lru_cache(maxsize=8)
def plants(count: int) -> tuple[Plant, ...]:
    """`count` perturbed plants: four numbers are normal about their nominal values; a draw with leakage <= 0 is repeated."""
    random, nominal = np.random.default_rng(PLANTS_SEED), InteractingActuator()
    found: list[Plant] = []
    while len(found) < count:
        drawn = {name: getattr(nominal, name) + size * float(random.standard_normal()) for name, size in DEVIATION.items()}
        if drawn["leakage"] > 0:
            found.append(plant(**drawn))
    return tuple(found)


def whole(case: int) -> tuple[Array, Array, Array]:
    """M, C and K of the frame: equal floor masses and the same damping ratio in all three modes."""
    mass, ratio = CASES[case]
    matrix = mass * np.eye(3)
    values, modes = eigh(STIFFNESS, matrix)
    damping: Array = matrix @ modes @ np.diag(2 * ratio * np.sqrt(values)) @ modes.T @ matrix
    return matrix, damping, STIFFNESS


def numerical(case: int, specimen: LinearWithMass) -> MatricesStructure:
    """The analytical substructure: the frame less the specimen, under the load of the whole mass."""
    mass, damping, stiffness = (matrix.copy() for matrix in whole(case))
    influence = np.ones(3)
    influence[0] = mass[0, 0] / (mass[0, 0] - specimen.mass)
    for matrix, part in ((mass, specimen.mass), (damping, specimen.damping), (stiffness, specimen.stiffness)):
        matrix[0, 0] -= part
    return MatricesStructure(
        mass=_rows(mass), damping=_rows(damping), stiffness=_rows(stiffness), influence=tuple(influence.tolist())
    )


def _rows(matrix: Array) -> tuple[Row, ...]:
    return tuple(tuple(row) for row in ((matrix + matrix.T) / 2).tolist())


def benchmark(
    case: int, compensator: Compensator, rig: Plant | None = None, record: str = EL_CENTRO, noisy: bool = True, seed: int = 1
) -> Plan:
    """The plan of a partitioning case with a compensator, on the nominal plant or on another one."""
    rig = rig or plant()
    station = Station(
        name="First storey",
        storey=1,
        compensator=compensator,
        actuator=rig.actuator,
        specimen=rig.specimen,
        noise=Noise(displacement=DISPLACEMENT_NOISE, force=FORCE_NOISE) if noisy else Noise(),
        limits=LIMITS,
    )
    mass, ratio = CASES[case]
    return Plan(
        name=f"Virtual RTHS benchmark, case {case}",
        notes=f"After Silva et al. (2020): a three-storey frame with floors of {mass:g} kg and {ratio:.0%} damping. A frame of "
        "its first storey is in the laboratory. The transfer system delays by 25 ms, and the frame changes the delay.",
        template=name(case),
        motion=RecordMotion(record=record, scale=Factor(factor=INTENSITY)),
        structure=numerical(case, rig.specimen),
        integrator=ExplicitNewmark(dt=1 / RATE, substeps=1),
        controller_rate=RATE,
        stations=(station,),
        seed=seed,
    )


def name(case: int) -> str:
    """The name of the template of a case."""
    return f"vrths-{case}"


def known(case: int) -> TransferSystem:
    """What is known of the transfer system before the test: its nominal transfer function and the expected motion."""
    numerator, denominator = InteractingActuator().transfer_function()
    displacement, velocity = EXPECTED[case]
    return TransferSystem(numerator, denominator, RATE, 1 / RATE, displacement, velocity, DISPLACEMENT_NOISE)


def template(case: int) -> Plan:
    """The template of a case: nominal plant, El Centro at 0.4, adaptive time series compensation."""
    return benchmark(case, AdaptiveTimeSeries.tuned_for(known(case)))


VRTHS = {name(case): case for case in CASES}
