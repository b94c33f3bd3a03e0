"""Preview of a drive: its displacement against time."""

from __future__ import annotations

from typing import Any

import numpy as np
from pydantic import Field

from rths_engine.foundation.errors import PlanError
from rths_engine.foundation.part import Value, quantity, validated
from rths_engine.planning.checks import peaks, too_long
from rths_engine.planning.excitation import Drive
from rths_engine.results.decimate import extremes

SAMPLES, BUCKETS = 40_000, 500


class Asked(Value):
    """The fields of a plan that decide the command."""

    drive: Drive = Field(title="Drive")
    controller_rate: float = quantity("Controller rate", "Hz", ge=1, le=100_000)
    duration: float | None = quantity("Duration", "s", gt=0, le=3600, default=None)


def preview(data: Any) -> dict[str, Any]:
    """Decimated time (s) and displacement (m) with all extremes, peak (m) and largest velocity (m/s). Raises PlanError."""
    asked = validated(Asked, data)
    issues = tuple(too_long("drive.shape", asked.drive.shape))
    if issues:
        raise PlanError(issues)
    duration = asked.duration or asked.drive.shape.duration
    time = np.linspace(0.0, duration, min(SAMPLES, round(duration * asked.controller_rate) + 2))
    displacement = asked.drive.sample(time)
    kept = extremes(displacement[:, None], BUCKETS)
    peak, velocity = peaks(asked.drive, duration, asked.controller_rate)
    return {
        "time": time[kept].tolist(),
        "displacement": displacement[kept].tolist(),
        "peak": peak,
        "velocity": velocity,
        "duration": duration,
    }
