"""Records that film gave: time and value side by side, five or four pairs a line, often at uneven times."""

from __future__ import annotations

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import FileError, Issue

_UNIFORM = 0.05  # of a step, beside the rounding of the times; chosen, see docs/decisions/0023


def uniform_step(times: Array, rounding: float, where: str) -> float:
    """The step (s) of times that are written to within `rounding` (s). Raises FileError where they are not uniform."""
    steps = np.diff(times)
    if len(steps) and np.min(steps) < 0:
        at = int(np.argmin(steps))
        problem = "the time decreases"
        raise FileError(Issue(where, f"{problem} after pair {at + 1}", f"{times[at]:g} s", "get the record again"))
    dt = float(f"{(times[-1] - times[0]) / max(len(steps), 1):.6g}")
    if dt <= 0:
        raise FileError(Issue(where, "the time does not increase", f"{times[-1]:g} s", "get the record again"))
    off = np.abs(times - times[0] - np.arange(len(times)) * dt)
    if np.max(off) > rounding + _UNIFORM * dt:
        problem = (
            f"contains a film record at uneven times: steps of {np.min(steps):.4g} to {np.max(steps):.4g} s, mean {dt:.4g} s"
        )
        fix = "give the corrected record (volume 2), or interpolate it to a uniform step yourself"
        raise FileError(Issue(where, problem, fix=fix))
    return dt
