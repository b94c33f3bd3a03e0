"""Small curves of live signals as SVG paths: the smallest and largest value of each pixel column."""

from __future__ import annotations

import numpy as np

from rths_engine.foundation.arrays import Array

COLUMNS = 120
WIDTH, HEIGHT = 240.0, 40.0  # of the drawing, in its own units
MARGIN = 0.06  # of the height, above and below


def path(lowest: Array, highest: Array, buckets: int, scale: float) -> str:
    """The curve of a signal with `lowest` and `highest` values of its buckets so far, of `buckets` in the whole test.

    Zero is in the middle and `scale` at the upper edge. A bucket without a finite value is a gap.
    """
    width = max(1, -(-buckets // COLUMNS))
    parts: list[str] = []
    drawing = False
    for first in range(0, len(lowest), width):
        low, high = lowest[first : first + width], highest[first : first + width]
        low, high = low[np.isfinite(low)], high[np.isfinite(high)]
        if not (len(low) and len(high)):
            drawing = False
            continue
        x = WIDTH * min(buckets, first + width / 2) / buckets
        upper, lower = (_y(float(value), scale) for value in (high.max(), low.min()))
        parts.append(f"{'L' if drawing else 'M'}{x:.1f} {lower:.1f}L{x:.1f} {upper:.1f}")
        drawing = True
    return "".join(parts)


def _y(value: float, scale: float) -> float:
    share = value / scale if scale else 0.0
    return HEIGHT / 2 * (1 - (1 - 2 * MARGIN) * share)
