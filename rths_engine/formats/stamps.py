"""Time stamps that lie on equal steps, so that start and step say the same."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from rths_engine.formats.table import Column
from rths_engine.foundation.arrays import Array

# chosen; see docs/decisions/0023
ROUNDING = 1e-3  # of a step: larger differences from equal steps are not the rounding of the stamps


def equal_steps(stamps: Array) -> tuple[float, float] | None:
    """Start and step of the stamps, in their unit; None where they differ from equal steps by more than ROUNDING."""
    stamps = np.asarray(stamps, dtype=float)
    if len(stamps) < 2 or not np.isfinite(stamps).all():
        return None
    start, step = float(stamps[0]), float(stamps[-1] - stamps[0]) / (len(stamps) - 1)
    if step <= 0 or np.max(np.abs(stamps - (start + np.arange(len(stamps)) * step))) > ROUNDING * step:
        return None
    return start, step


def timed(columns: Sequence[Column], stamps: Column) -> list[Column]:
    """The columns with the start and step of their stamps (s); uneven stamps become a column of their own before them."""
    found = equal_steps(stamps.values)
    if found is not None:
        return [replace(one, start=found[0], dt=found[1]) for one in columns]
    return [replace(stamps, quantity="time"), *(replace(one, time=stamps.name) for one in columns)]
