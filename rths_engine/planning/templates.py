"""Templates of plans: the twelve simulations of Table III of Chen and Ricles (2012), EESD 41, 549-569, and the examples.

A shear building with the storey stiffnesses, the first period and 2 % damping represents the paper's frame. First-order delays
of 30 and 45 controller steps represent its actuators, and a bundled record of the same earthquake its ground motion. The factor
of the record was chosen once, to give about the floor displacements of the paper's simulation 2.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from rths_engine.foundation.errors import Issue, PlanError
from rths_engine.parts.actuators.first_order_delay import FirstOrderDelay
from rths_engine.parts.compensators import Compensator
from rths_engine.parts.compensators.aic import AdaptiveInverseCompensation
from rths_engine.parts.compensators.inverse import InverseCompensation
from rths_engine.parts.compensators.none import NoCompensation
from rths_engine.parts.ground_motions.scaling import Factor
from rths_engine.parts.specimens.mr_damper import MrDamper
from rths_engine.parts.structures.shear_building import ShearBuilding, Storey
from rths_engine.planning.examples import EXAMPLES
from rths_engine.planning.motion import RecordMotion
from rths_engine.planning.plan import Noise, Plan, Station

# Chen and Ricles (2012); the last two, chosen for it: docs/decisions/0013
STOREY_STIFFNESS = (36_007e3, 23_894e3)  # N/m
FIRST_PERIOD = 1.48  # s
ACTUATOR_ALPHA = (30.0, 45.0)
FORCE_CAPACITY = (2.3e6, 1.7e6)  # N
VELOCITY_CAPACITY = (0.56, 0.76)  # m/s
DAMPERS = (6, 4)
TABLE3 = "Chen and Ricles (2012), Table III"
GROUPS = {
    "hybrid": "Hybrid tests",
    "specimen": "Tests of a specimen",
    "actuator": "Tests of an actuator",
    "structure": "Tests of a structure alone",
}
BRACE_STIFFNESS = 4e8  # N/m, lateral, of all braces of a storey: docs/decisions/0013
NORTHRIDGE = RecordMotion(record="northridge-1994-beverly-hills-009", scale=Factor(factor=0.6))


@dataclass(frozen=True, slots=True)
class PaperRow:
    """One row of Tables III and IV: compensation, and the measures of both stations, or None where the test was unstable."""

    simulation: int
    alpha_es: tuple[float, float]
    kp: float  # 1/mm^2
    mte_mm: tuple[float, float] | None
    rms_percent: tuple[float, float] | None
    mti_mm2: tuple[float, float] | None
    mee_kNm: tuple[float, float] | None


# Chen and Ricles (2012), Tables III and IV
_ROWS = (
    PaperRow(1, (1, 1), 0.0, None, None, None, None),
    PaperRow(2, (1, 1), 0.4, (2.0, 3.2), (2.5, 5.2), (46.8, 73.5), (-5.5, -6.2)),
    PaperRow(3, (30, 30), 0.0, (0.6, 2.3), (1.3, 3.7), (9.1, 160.2), (-2.4, -3.4)),
    PaperRow(4, (30, 30), 0.4, (0.8, 1.6), (1.4, 2.0), (11.8, 48.1), (-2.6, -2.3)),
    PaperRow(5, (60, 60), 0.0, (5.9, 3.9), (11.2, 7.7), (-790.7, -269.9), (-2.9, -1.4)),
    PaperRow(6, (60, 60), 0.4, (1.6, 1.8), (2.8, 3.3), (-53.0, -31.9), (-3.2, -3.8)),
    PaperRow(7, (1, 45), 0.0, None, None, None, None),
    PaperRow(8, (1, 60), 0.0, (6.3, 4.1), (12.7, 8.9), (1304.2, -454.2), (-22.7, -2.9)),
    PaperRow(9, (1, 60), 0.4, (1.1, 1.9), (2.4, 3.0), (52.7, -31.2), (-4.0, -2.1)),
    PaperRow(10, (30, 1), 0.0, None, None, None, None),
    PaperRow(11, (60, 1), 0.0, (6.8, 9.3), (12.2, 18.2), (-1088.8, 1014.5), (-5.0, -27.7)),
    PaperRow(12, (60, 1), 0.4, (1.5, 1.9), (2.7, 3.9), (-55.5, 90.0), (-2.8, -4.6)),
)
PAPER = {f"table3-{row.simulation:02d}": row for row in _ROWS}


def names() -> list[str]:
    """Names of all templates."""
    return [*PAPER, *EXAMPLES]


def group(name: str) -> str:
    """The heading under which a template is listed."""
    return TABLE3 if name in PAPER else GROUPS[template(name).test]


def template(name: str) -> Plan:
    """The plan named `name`. Raises PlanError with the names of all templates."""
    if name in PAPER:
        return _table3(name, PAPER[name])
    if name in EXAMPLES:
        return EXAMPLES[name](name)
    raise PlanError(Issue("", f"the template '{name}' does not exist", fix="choose one of " + ", ".join(names())))


def _table3(name: str, row: PaperRow) -> Plan:
    kp = f", kp = {row.kp:g}" if row.kp else ""
    alphas = f"α_es = {row.alpha_es[0]:g} and {row.alpha_es[1]:g}{kp}"
    return Plan(
        name=f"Table III, simulation {row.simulation} ({alphas})",
        notes="Source: Chen and Ricles (2012), EESD 41, 549-569. A shear building replaces the moment-resisting frame.",
        template=name,
        motion=NORTHRIDGE,
        structure=_building(),
        stations=tuple(_station(j, _compensator(row, j)) for j in range(2)),
        seed=row.simulation,
        duration=40.0,
    )


def _compensator(row: PaperRow, j: int) -> Compensator:
    if row.kp:
        kp = row.kp * 1e6
        return AdaptiveInverseCompensation(alpha_es=row.alpha_es[j], kp=kp, ki=kp / 10)
    return InverseCompensation(alpha_es=row.alpha_es[j]) if row.alpha_es[j] > 1 else NoCompensation()


def _station(j: int, compensator: Compensator) -> Station:
    actuator = FirstOrderDelay(alpha=ACTUATOR_ALPHA[j], force_limit=FORCE_CAPACITY[j], velocity_limit=VELOCITY_CAPACITY[j])
    return Station(
        name=f"Storey {j + 1} damper",
        storey=j + 1,
        dampers=DAMPERS[j],
        compensator=compensator,
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
    heights = (4.57, 3.96)
    storeys = tuple(Storey(mass=mass, stiffness=k, height=h) for k, h in zip(STOREY_STIFFNESS, heights, strict=True))
    return ShearBuilding(storeys=storeys, damping_ratio=0.02)
