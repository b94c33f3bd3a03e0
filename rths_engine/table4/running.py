"""Run the twelve simulations and make their rows of the table."""

from __future__ import annotations

from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor

import numpy as np

from rths_engine.parts.ground_motions import MotionLibrary
from rths_engine.planning.paper import HEIGHTS
from rths_engine.planning.plan import Plan
from rths_engine.results.result import Result
from rths_engine.running.run import simulate
from rths_engine.table4.comparison import Row

# chosen; see docs/decisions/0023
CORES = 2


def run_all(plans: Mapping[int, Plan], motions: MotionLibrary) -> dict[int, Result]:
    """The result of each simulation. They run on two cores, because the compiled loop releases Python's global lock."""
    with ThreadPoolExecutor(CORES) as threads:
        return dict(zip(plans, threads.map(lambda plan: simulate(plan, motions), plans.values()), strict=True))


def rows(results: Mapping[int, Result]) -> list[Row]:
    """The rows of Table IV from the results of its simulations."""
    return [
        Row(simulation, result.status, result.trip.time_s if result.trip else None, result.summary()["stations"])
        for simulation, result in results.items()
    ]


def drifts_percent(result: Result) -> list[float]:
    """Peak drift of each storey over its height, %."""
    floors = np.array([np.zeros(len(result.signals)), *(result.signal(f"x_floor.{floor}") for floor in (1, 2))])
    peaks = np.max(np.abs(np.diff(floors, axis=0)), axis=1)
    return [float(peak) / height * 100 for peak, height in zip(peaks, HEIGHTS, strict=True)]
