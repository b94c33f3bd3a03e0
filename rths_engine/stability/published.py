"""The two-storey structure of section 2 of Chen and Ricles (2012): its characteristic polynomial and the limit of Figure 3."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.polynomial import Polynomial

from rths_engine.foundation.arrays import Array
from rths_engine.parts.actuators.first_order_delay import FirstOrderDelay
from rths_engine.parts.compensators.none import NoCompensation
from rths_engine.parts.integrators.cr import CrIntegrator
from rths_engine.parts.specimens.linear import LinearSpecimen
from rths_engine.parts.structures.modes import circular_frequencies, rayleigh
from rths_engine.parts.structures.shear_building import ShearBuilding, Storey
from rths_engine.planning.motion import InlineMotion
from rths_engine.planning.plan import Plan, Station
from rths_engine.stability.closed_loop import stable
from rths_engine.stability.margins import MOST, crossing

# Chen and Ricles (2012), section 2
MASS = 5e5  # kg, each floor
STIFFNESS = 5e7  # N/m, each storey (the text prints kN/m; its periods of 1.02 and 0.39 s need N/m)
DAMPING_RATIO = 0.02
DT = 0.01  # s, without substeps


def characteristic(alpha: tuple[float, float], ratio: float = DAMPING_RATIO) -> Array:
    """Coefficients a0 ... a6 of equation (6c), with half of each storey's stiffness experimental.

    With (3), (4) and G_j(z) = z / l_j, l_j = alpha_j z - (alpha_j - 1) (5b), the determinant of
    P + 4 dt^2 z (k_1e G_1 e e^T + k_2e G_2 u u^T),  P = (4 M + 2 dt C + dt^2 K) (z - 1)^2 + 4 dt C (z - 1) + 4 dt^2 z K_a,
    with strokes e = (1, 0) and u = (-1, 1), times l_1 l_2.
    """
    mass, total = MASS * np.eye(2), _storeys(STIFFNESS)
    damping = rayleigh(mass, total, ratio, circular_frequencies(mass, total))
    z, move = Polynomial([0.0, 1.0]), Polynomial([-1.0, 1.0])
    effective = 4 * mass + 2 * DT * damping + DT**2 * total

    def entry(i: int, j: int) -> Any:
        return effective[i, j] * move**2 + 4 * DT * damping[i, j] * move + 2 * DT**2 * total[i, j] * z

    p11, p12, p22 = entry(0, 0), entry(0, 1), entry(1, 1)
    lag1, lag2 = (Polynomial([1 - one, one]) for one in alpha)
    felt = 2 * DT**2 * STIFFNESS * z**2
    found = (p11 * p22 - p12 * p12) * lag1 * lag2
    found += felt * p22 * lag2 + felt * (p11 + p22 + 2 * p12) * lag1 + felt * felt
    return np.asarray(found.coef, dtype=float)


def radius(alpha: tuple[float, float], ratio: float = DAMPING_RATIO) -> float:
    """Spectral radius of the published closed loop with actuator constants `alpha`."""
    return float(np.max(np.abs(Polynomial(characteristic(alpha, ratio)).roots())))


def limit(alpha1: float) -> float | None:
    """alpha2 at the stability limit of Figure 3 for a given alpha1; None where no alpha2 is stable."""

    def holds(alpha2: float) -> bool:
        return stable(radius((alpha1, alpha2)))

    return crossing(holds, np.linspace(1.0, MOST, 1000)) if holds(1.0) else None


def largest_alpha1() -> float:
    """alpha1 at the stability limit when the second actuator has no delay."""
    found = crossing(lambda alpha1: stable(radius((alpha1, 1.0))), np.linspace(1.0, MOST, 1000))
    return MOST if found is None else found


def section2(alpha: tuple[float, float]) -> Plan:
    """The structure as a plan. Its damping ratio is that of half of the stiffness with the same C = a0 M + a1 K."""
    storey = Storey(mass=MASS, stiffness=STIFFNESS / 2)
    return Plan(
        name="Section 2 of Chen and Ricles (2012)",
        motion=InlineMotion(dt=DT, acceleration=(0.0, 0.0)),
        structure=ShearBuilding(storeys=(storey, storey), damping_ratio=math.sqrt(2) * DAMPING_RATIO),
        integrator=CrIntegrator(dt=DT, substeps=1),
        controller_rate=1 / DT,
        stations=tuple(_station(j, alpha[j]) for j in range(2)),
    )


def _station(j: int, alpha: float) -> Station:
    return Station(
        name=f"Storey {j + 1} spring",
        storey=j + 1,
        compensator=NoCompensation(),
        actuator=FirstOrderDelay(alpha=alpha),
        specimen=LinearSpecimen(stiffness=STIFFNESS / 2, damping=0.0),
        equivalent_stiffness=STIFFNESS / 2,
    )


def _storeys(stiffness: float) -> Array:
    return stiffness * np.array([[2.0, -1.0], [-1.0, 1.0]])
