"""A dry run: the plan runs as fast as possible, within a bounded time and memory, and nothing is stored."""

from __future__ import annotations

import time
from dataclasses import dataclass

import numpy as np

from rths_engine.parts.ground_motions import MotionLibrary
from rths_engine.planning import motion
from rths_engine.planning.model import Model
from rths_engine.planning.safety import Limits
from rths_engine.results.channels import channels
from rths_engine.results.result import Result
from rths_engine.running.run import Run

# chosen; see docs/decisions/0023
MOST_NUMBERS = 20_000_000  # recorded numbers and sensor noise of a dry run: 160 MB
CHUNK_S = 0.05  # wall time between two looks at the clock

NONE = Limits.model_construct(displacement=np.inf, velocity=np.inf, force=np.inf, oscillation=0)


@dataclass(frozen=True, slots=True)
class DryRun:
    """A dry run and its result. `planned_s` (s) is the duration of the whole test, `elapsed_s` the wall time after step 1."""

    run: Run
    result: Result
    planned_s: float
    elapsed_s: float

    @property
    def covered_s(self) -> float:
        """Simulated time (s)."""
        return self.run.done * self.run.dt

    @property
    def complete(self) -> bool:
        """Whether the dry run reached the end of the test, or a trip."""
        return self.run.trip is not None or self.covered_s >= self.planned_s - self.run.plan.step


def dry_run(model: Model, motions: MotionLibrary, budget_s: float) -> DryRun:
    """Run the plan until its end, a trip, or `budget_s` of wall time after its first step. Raises PlanError or MotionError.

    The first step may load or compile the engine, which takes longer than most tests.
    """
    plan = model.plan
    planned = plan.length(motion.scaled(plan.motion, motions, model.periods).duration)
    row = len(channels(model)) + 2 * len(plan.stations)
    longest = MOST_NUMBERS / row * plan.substep
    run = Run(model.changed(duration=longest) if planned > longest else model, motions)
    run.advance(1)
    start = time.perf_counter()
    steps = 1
    while not run.finished and (now := time.perf_counter()) < start + budget_s:
        run.advance(steps)
        taken = time.perf_counter() - now
        steps = max(1, round(steps * min(8.0, CHUNK_S / max(taken, 1e-6))))
    elapsed = time.perf_counter() - start
    return DryRun(run, run.result("tripped" if run.trip else "completed", elapsed), planned, elapsed)


def without_limits(model: Model) -> Model:
    """The model of the plan without the safety limits of its stations."""
    return model.changed(stations=tuple(one.model_copy(update={"limits": NONE}) for one in model.plan.stations))
