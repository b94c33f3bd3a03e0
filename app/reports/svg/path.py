"""A line as the data of an SVG path: short, with gaps where a sample is missing."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from app.reports.packed import Samples
from rths_engine.results.decimate import extremes

FINE = 10  # coordinates are whole numbers of 1/10 px
MOST = 3000  # points of a line that goes back and forth, such as a loop


def thinned(x: Samples, y: Samples, width: float, most: int = MOST) -> tuple[Samples, Samples]:
    """The points that show: extremes of each pixel for a line along x, and at most about `most` points of another line."""
    forward = len(x) < 2 or bool(np.all(np.diff(np.nan_to_num(x)) >= 0))
    points = y[:, None] if forward else np.column_stack([x, y])
    buckets = int(min(width, most / 2)) if forward else most // 4
    kept = extremes(points, max(20, buckets))
    return x[kept], y[kept]


def path(x: Samples, y: Samples) -> str:
    """Path data of points in px, in units of 1/10 px: absolute starts, relative steps. NaN interrupts the line."""
    known = np.isfinite(x) & np.isfinite(y)
    return "".join(_stretch(x[part], y[part]) for part in _parts(known))


def _parts(known: NDArray[np.bool_]) -> list[slice]:
    edges = np.flatnonzero(np.diff(np.concatenate([[0], known.astype(np.int8), [0]])))
    return [slice(int(first), int(last)) for first, last in edges.reshape(-1, 2)]


def _stretch(x: Samples, y: Samples) -> str:
    points = np.round(np.column_stack([x, y]) * FINE).astype(np.int64)
    steps = np.diff(points, axis=0)
    steps = steps[np.any(steps != 0, axis=1)]
    if not len(steps):  # a dot: a line without length and with round ends
        return f"M{points[0, 0]} {points[0, 1]}h0"
    pairs = "".join(f"{'' if dx < 0 else ' '}{dx}{'' if dy < 0 else ' '}{dy}" for dx, dy in steps.tolist())
    return f"M{points[0, 0]} {points[0, 1]}l{pairs.lstrip()}"
