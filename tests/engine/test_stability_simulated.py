"""Predicted stability against simulated growth, on random linear plans away from the limit.

The 500 plans: `pytest -m slow tests/engine/test_stability_simulated.py`.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from rths_engine.parts.structures.shear_building import ShearBuilding
from rths_engine.planning.plan import Plan
from rths_engine.running.run import Run
from rths_engine.stability import ClosedLoop
from tests.engine.plans import LIBRARY, NO_LIMITS, building, make, quiet

AWAY = 1e-3  # |rho - 1| of the plans compared
EFOLDS = 6.0  # growth or decay exp(EFOLDS) of the slowest mode in a run outlasts every transient


def random_plan(rng: np.random.Generator) -> Plan:
    storeys, substeps = int(rng.integers(1, 5)), int(rng.integers(1, 13))
    period, ratio = rng.uniform(0.3, 2.0), rng.uniform(0.0, 0.05)
    masses = rng.uniform(1e5, 5e5, storeys)
    stiffness = masses[0] * (2 * np.pi / period) ** 2 * storeys**2
    stiffnesses = stiffness * rng.uniform(0.6, 1.4, storeys)
    stations: list[dict[str, Any]] = []
    for storey in rng.permutation(storeys)[: int(rng.integers(1, storeys + 1))]:
        dampers = int(rng.integers(1, 7))
        own = stiffnesses[storey] * rng.uniform(0.0, 1.0) / dampers
        damping = 2 * rng.uniform(0.0, 0.05) * np.sqrt(stiffnesses[storey] * masses[storey]) / dampers
        alpha = float(rng.uniform(1, 60))
        known = rng.choice([0.0, 0.0, 0.5, 1.0, 1.5])
        stations.append(
            {
                "name": f"S{storey}",
                "storey": int(storey) + 1,
                "dampers": dampers,
                "equivalent_stiffness": own * rng.choice([0.0, 1.0]),
                "equivalent_damping": damping * rng.choice([0.0, 1.0]),
                "compensator": {"kind": "inverse", "alpha_es": max(1.0, known * alpha)},
                "actuator": {"kind": "first_order_delay", "alpha": alpha, "velocity_limit": 10, "force_limit": 1e8},
                "specimen": {"kind": "linear", "stiffness": own, "damping": damping},
                "limits": NO_LIMITS,
            }
        )
    structure = building(masses.tolist(), stiffnesses.tolist(), ratio)
    return make(structure, quiet(1.0), substeps / 1024, substeps, stations=stations)


def grows(plan: Plan, radius: float, rng: np.random.Generator) -> bool:
    """Whether a free vibration from a small random start is larger in its last tenth than in its second."""
    steps = int(np.clip(EFOLDS / abs(np.log(radius)), 200, 8000))
    changed = plan.model_copy(update={"duration": steps * plan.integrator.dt})
    assert isinstance(plan.structure, ShearBuilding)
    dof = len(plan.structure.storeys)
    run = Run(changed, LIBRARY, initial=(rng.normal(scale=1e-9, size=dof).tolist(), rng.normal(scale=1e-8, size=dof).tolist()))
    run.advance(run.total)
    if run.trip:
        return True
    x, part = run.history[:, 0], steps // 10
    return bool(np.sum(x[-part:] ** 2) > np.sum(x[part : 2 * part] ** 2))


def agreement(count: int, seed: int) -> tuple[int, int]:
    """Plans predicted as simulated, and how many of them are stable."""
    rng = np.random.default_rng(seed)
    right = held = done = 0
    while done < count:
        plan = random_plan(rng)
        radius = ClosedLoop(plan).radius()
        if abs(radius - 1) <= AWAY:
            continue
        done += 1
        held += radius < 1
        right += grows(plan, radius, rng) == (radius > 1)
    return right, held


def test_forty_random_plans_grow_or_decay_as_predicted() -> None:
    right, held = agreement(40, seed=1)
    assert right == 40
    assert 8 <= held <= 32


@pytest.mark.slow
def test_five_hundred_random_plans_grow_or_decay_as_predicted() -> None:
    right, held = agreement(500, seed=2)
    assert right >= 0.99 * 500
    assert 100 <= held <= 400
