"""The predicted stability of a plan within a bounded time: spectral radius, and the delay margin of each station."""

from __future__ import annotations

import time
from collections.abc import Mapping
from typing import Any

from rths_engine.foundation.errors import PlanError
from rths_engine.planning.model import Model
from rths_engine.stability import SHARED, ClosedLoop, margin, stable, unpredicted
from rths_engine.stability.station import Lifted


class OutOfTime(Exception):
    """The time for the prediction is over."""


class TimedLoop(ClosedLoop):
    """A closed loop whose radius raises OutOfTime after `deadline` (s of `time.perf_counter`)."""

    def __init__(self, model: Model, deadline: float):
        super().__init__(model)
        self._deadline = deadline

    def radius(self, changed: Mapping[int, Lifted] | None = None) -> float:
        if time.perf_counter() > self._deadline:
            raise OutOfTime
        return super().radius(changed)


def margins(model: Model, deadline: float) -> dict[str, Any] | None:
    """`radius` and `stable` of the loop, delay margins of its `stations` in order, and `notes`; None for a plan without a loop.

    A value that is not known by the deadline is None, and a note says so.
    """
    plan = model.plan
    if plan.driven or not plan.stations:
        return None
    names = [station.name for station in plan.stations]
    found: dict[str, Any] = {"radius": None, "stable": None, "stations": [], "notes": []}
    if plan.couplings:
        return {**found, "notes": [SHARED]}
    try:
        loop = TimedLoop(model, deadline)
        found["notes"] = loop.notes()
        found["radius"] = loop.radius()
        found["stable"] = stable(found["radius"])
        for j, name in enumerate(names):
            steps = margin(loop, j)
            seconds = None if steps is None else steps * plan.substep
            found["stations"].append({"station": j + 1, "name": name, "steps": steps, "seconds": seconds})
    except PlanError as error:
        found["notes"].append(unpredicted(error))
    except OutOfTime:
        known = len(found["stations"])
        what = f"the delay margins of stations {known + 1} to {len(names)}" if found["radius"] is not None else "the stability"
        found["notes"].append(
            f"There was no time for {what}: the structure is large or the computer busy. `rths stability` has no time limit."
        )
    return found
