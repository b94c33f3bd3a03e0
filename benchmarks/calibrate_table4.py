"""`python -m benchmarks.calibrate_table4 RECORD [SEED]`: fit the emulated laboratory to simulations 3 and 4 of Table IV.

The loss is the mean of ln^2(ours/paper) over MTE, RMS, MTI and MEE of both stations in simulations 3 and 4. Each term is at
most ln^2 20, and a wrong sign counts ln^2 20. To this, 10 ln^2 of the floor peaks of simulation 2 over the paper's (geometric
mean) is added; it sets the factor of the record. A test that trips has the loss 10. The other simulations are not used.

With a seed, differential evolution first searches within BOUNDS. Without a seed, the simplex method refines the present
laboratory.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict
from typing import Any

import numpy as np
from scipy.optimize import differential_evolution, minimize

from rths_engine import table4
from rths_engine.parts.ground_motions import MotionLibrary
from rths_engine.parts.ground_motions.scaling import Factor
from rths_engine.planning.motion import FileMotion
from rths_engine.running.run import simulate
from rths_engine.table4.comparison import CALIBRATED, MEASURES, PAPER, published
from rths_engine.table4.scale import design_basis, floors_excess

# bounds of the search, on a logarithmic axis
BOUNDS = {
    "first_time_constant": (24e-3, 32e-3),
    "second_time_constant": (30e-3, 44e-3),
    "delay_growth": (5e-3, 0.2),
    "displacement_noise": (5e-6, 2e-4),
    "factor": (0.36, 0.56),
}
WORST, TRIPPED = math.log(20) ** 2, 10.0
POPULATION, GENERATIONS = 4, 40
SIMPLEX, REFINED = 0.04, 80


def main(path: str, seed: int | None) -> None:
    """Fit the unknown parameters of the laboratory, from their present values or with a seed within BOUNDS, and print them."""
    motion, motions = FileMotion(path=path, unit="g", dt=0.02), MotionLibrary(None)

    def cost(logarithms: np.ndarray) -> float:
        laboratory, factor = described(logarithms)
        return loss(laboratory, motion.model_copy(update={"scale": Factor(factor=factor)}), motions)

    if seed is None:
        scale = design_basis(motion, motions).scale
        assert isinstance(scale, Factor)
        start = present(scale.factor)
    else:
        start = searched(cost, seed)
    simplex = np.vstack([start, start + SIMPLEX * np.eye(len(start))])
    found = minimize(cost, start, method="Nelder-Mead", options={"maxfev": REFINED, "initial_simplex": simplex})
    laboratory, factor = described(found.x)
    print(f"loss {found.fun:.4f} (from {cost(start):.4f}), factor {factor:.4f}", asdict(laboratory))


def searched(cost: Callable[[np.ndarray], float], seed: int) -> np.ndarray:
    """The best parameters of a differential evolution within BOUNDS, as logarithms."""
    bounds = [(math.log(low), math.log(high)) for low, high in BOUNDS.values()]
    options: dict[str, Any] = {"popsize": POPULATION, "maxiter": GENERATIONS, "mutation": (0.4, 0.9), "recombination": 0.8}
    with ThreadPoolExecutor(2) as threads:
        found = differential_evolution(
            cost, bounds, rng=seed, init="sobol", polish=False, updating="deferred", workers=threads.map, **options
        )
    best: np.ndarray = found.x
    return best


def present(factor: float) -> np.ndarray:
    """The present parameters and the factor of the record, as logarithms."""
    values = asdict(table4.LABORATORY)
    first, second = values.pop("time_constant")
    values |= {"first_time_constant": first, "second_time_constant": second, "factor": factor}
    return np.log([values[name] for name in BOUNDS])


def described(logarithms: np.ndarray) -> tuple[table4.Laboratory, float]:
    """The laboratory and the factor of the record from logarithms."""
    values = dict(zip(BOUNDS, map(float, np.exp(logarithms)), strict=True))
    factor = values.pop("factor")
    constants = values.pop("first_time_constant"), values.pop("second_time_constant")
    return table4.Laboratory(time_constant=constants, **values), factor


def loss(laboratory: table4.Laboratory, motion: FileMotion, motions: MotionLibrary) -> float:
    """The loss: see the docstring of this module."""
    plans = table4.plans(motion, laboratory)
    terms = []
    for simulation in CALIBRATED:
        result = simulate(plans[simulation], motions)
        if result.trip:
            return TRIPPED
        for j, station in enumerate(result.summary()["stations"]):
            ratios = [station[field] / published(PAPER[simulation], field, j) for field in MEASURES]
            terms += [min(WORST, math.log(ratio) ** 2) if ratio > 0 else WORST for ratio in ratios]
    return float(np.mean(terms)) + 10 * floors_excess(motion, motions, laboratory) ** 2


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else None)
