"""Execution of the points of a sweep, one after another, in one process: only the measures of each are kept."""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

from rths_engine.foundation import units
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import RthsError
from rths_engine.parts.ground_motions import Motion, MotionLibrary
from rths_engine.parts.ground_motions.spectrum import spectral_acceleration
from rths_engine.planning.motion import InlineMotion
from rths_engine.planning.plan import Plan
from rths_engine.planning.reading import read_model
from rths_engine.planning.safety import LIMITS
from rths_engine.results.measure import FloorMeasure, RunMeasure
from rths_engine.running.run import Run, sensor_noise
from rths_engine.sweeps.columns import IM_DAMPING, STATUSES, Column
from rths_engine.sweeps.design import Design

# chosen; see docs/decisions/0023
CHUNK_S = 0.1  # computing time between two looks for a cancel
FIRST_CHUNK = 2000  # integration steps


@dataclass(frozen=True, slots=True)
class Row:
    """The results of a point: a value for each column, NaN where there is none; the reason of a point that did not complete."""

    values: tuple[float, ...]
    reason: str | None


class KeptMotions(MotionLibrary):
    """A library that reads each record once. A sweep reads the same records at every point."""

    def __init__(self, library: MotionLibrary):
        super().__init__(library.folder)
        self.get = lru_cache(maxsize=None)(library.get)  # type: ignore[method-assign]


class Points:
    """Executes points of a design. Points share the records, their spectra and the sensor noise of one seed."""

    def __init__(self, design: Design, columns: tuple[Column, ...], library: MotionLibrary):
        self.design, self.columns = design, columns
        self.library = KeptMotions(library)
        self._noise: tuple[Any, Array] | None = None
        self._spectral = lru_cache(maxsize=1024)(self._spectral_acceleration)

    def row(self, point: int, cancelled: Callable[[], bool] = lambda: False) -> Row | None:
        """The results of a point, or None where it was cancelled. An invalid or failed point is a row too, with its reason."""
        given, begun = self.design.inputs(point), time.perf_counter()
        found = _inputs(self.columns, given)
        try:
            run = Run(read_model(self.design.with_inputs(given)), self.library, noise=self._kept_noise)
            if not _to_end(run, cancelled):
                return None
            reason = self._take(run, time.perf_counter() - begun, found)
        except RthsError as error:
            reason = self._ended("invalid", found, "; ".join(str(issue) for issue in error.issues))
        except Exception as error:  # one point must not end the others
            reason = self._ended("failed", found, f"{type(error).__name__}: {error}")
        return Row(tuple(found.get(column.key, math.nan) for column in self.columns), reason)

    def _take(self, run: Run, elapsed_s: float, found: dict[str, float]) -> str | None:
        """Take the measures of a run that has ended. Returns its reason."""
        found |= self._intensity(run)
        result = run.result("tripped" if run.trip else "completed", elapsed_s)
        summary = result.summary()
        for column in self.columns:
            if column.measure:
                found[column.key] = _value(summary, column)
        found |= {"simulated_s": result.simulated_s, "elapsed_s": elapsed_s}
        if run.trip:
            found["trip_station"], found["trip_time_s"] = float(run.trip.station), run.trip.time_s
            found["trip_limit"] = float(list(LIMITS).index(run.trip.limit))
        return self._ended(result.status, found, run.trip.sentence if run.trip else None)

    def _ended(self, status: str, found: dict[str, float], reason: str | None) -> str | None:
        found["status"] = float(STATUSES.index(status))
        return reason

    def _intensity(self, run: Run) -> dict[str, float]:
        """Intensity measures of the ground motion as it acted."""
        plan = run.plan
        if plan.motion.kind == "none":
            return {}
        period = float(run.model.periods[0])
        unscaled = plan.motion.unscaled(self.library)
        pga, sa = unscaled.pga, self._sa(plan, unscaled, period)
        factor = run.motion.pga / pga if pga else math.nan
        gravity = units.factor("g")
        return {"scale_factor": factor, "pga_g": run.motion.pga / gravity, "sa_t1_g": factor * sa / gravity, "t1_s": period}

    def _sa(self, plan: Plan, unscaled: Motion, period: float) -> float:
        return (
            self._spectral(unscaled, period)
            if not isinstance(plan.motion, InlineMotion)
            else spectral_acceleration(unscaled, period, IM_DAMPING)
        )

    def _spectral_acceleration(self, motion: Motion, period: float) -> float:
        return spectral_acceleration(motion, period, IM_DAMPING)

    def _kept_noise(self, plan: Plan, total: int) -> Array:
        """The sensor noise of a plan, kept for the next point."""
        key = (plan.seed, total, tuple((one.noise.displacement, one.noise.force) for one in plan.stations))
        if self._noise is None or self._noise[0] != key:
            self._noise = key, sensor_noise(plan, total)
        return self._noise[1]


def _to_end(run: Run, cancelled: Callable[[], bool]) -> bool:
    """Run to the end; False where it was cancelled before."""
    steps = FIRST_CHUNK
    while not run.finished:
        if cancelled():
            return False
        begun = time.perf_counter()
        run.advance(steps)
        steps = max(1, round(steps * min(10.0, CHUNK_S / max(time.perf_counter() - begun, 1e-6))))
    return True


def _inputs(columns: tuple[Column, ...], given: list[float]) -> dict[str, float]:
    return dict(zip((column.key for column in columns if column.role == "input"), given, strict=True))


def _value(summary: dict[str, Any], column: Column) -> float:
    """The value of a measure in a run's summary; NaN where the plan of the point has no such station or floor."""
    found: Any = None
    if column.scope == RunMeasure.scope:
        found = summary[column.measure]
    else:
        listed = summary[column.measure] if column.scope == FloorMeasure.scope else summary["stations"]
        assert column.number is not None
        if column.number <= len(listed):
            found = listed[column.number - 1]
            found = found if column.scope == FloorMeasure.scope else found[column.measure]
    return math.nan if found is None else float(found)
