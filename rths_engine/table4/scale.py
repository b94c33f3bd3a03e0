"""The scale factor of the ground motion, from the published floor peaks of simulation 2."""

from __future__ import annotations

import math

from scipy.optimize import brentq

from rths_engine.foundation.errors import Issue, MotionError
from rths_engine.parts.ground_motions import MotionLibrary
from rths_engine.parts.ground_motions.scaling import Factor
from rths_engine.planning.laboratory import LABORATORY, Laboratory, PlannedRecord, plans
from rths_engine.planning.paper import VELOCITY_CAPACITY
from rths_engine.planning.safety import Limits
from rths_engine.running.run import simulate
from rths_engine.table4.comparison import FLOORS_PEAK_MM

# chosen; see docs/decisions/0023
LEAST, MOST = 0.01, 50.0
CLOSE = 1e-3  # tolerance of a factor
FAR = Limits(displacement=10.0, velocity=min(VELOCITY_CAPACITY))  # so that a run does not trip under too strong a motion


def design_basis(motion: PlannedRecord, motions: MotionLibrary, laboratory: Laboratory = LABORATORY) -> PlannedRecord:
    """`motion` with the factor that gives the paper's floor peaks of simulation 2, in the geometric mean.

    The paper scaled its record to the design basis earthquake by a factor that it does not state. It states the floor peaks of
    simulation 2, 49.6 and 94.6 mm. Raises MotionError where no factor gives these peaks.
    """

    def excess(logarithm: float) -> float:
        return floors_excess(_times(motion, math.exp(logarithm)), motions, laboratory)

    low, high = math.log(LEAST), math.log(MOST)
    if excess(low) > 0 or excess(high) < 0:
        problem = f"no factor from {LEAST:g} to {MOST:g} gives the floors of simulation 2 peaks of 49.6 and 94.6 mm"
        raise MotionError(Issue("record", problem, motion.scale.kind, "give the factor, or choose another record or unit"))
    return _times(motion, math.exp(float(brentq(excess, low, high, xtol=CLOSE))))


def _times(motion: PlannedRecord, factor: float) -> PlannedRecord:
    return motion.model_copy(update={"scale": Factor(factor=factor)})


def floors_excess(motion: PlannedRecord, motions: MotionLibrary, laboratory: Laboratory) -> float:
    """Logarithm of the floor peaks over those of the paper; 1 where the run exceeds the limits FAR."""
    plan = plans(motion, laboratory)[2]
    stations = tuple(station.model_copy(update={"limits": FAR}) for station in plan.stations)
    result = simulate(plan.model_copy(update={"stations": stations}), motions)
    if result.trip:
        return 1.0
    peaks = result.summary()["floors_peak_mm"]
    return sum(math.log(ours / paper) for ours, paper in zip(peaks, FLOORS_PEAK_MM, strict=True)) / 2
