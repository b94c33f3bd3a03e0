"""Decimation that keeps the shape of a plot: each bucket keeps its smallest and its largest sample."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rths_engine.foundation.arrays import Array


def extremes(signals: Array, buckets: int) -> NDArray[np.int64]:
    """Indices, in order, of the rows in which a column of `signals` (samples, columns) is extreme in its bucket.

    A short signal keeps all rows.
    """
    count, columns = signals.shape
    size = -(-count // max(1, buckets))
    if size <= 2 * columns:
        return np.arange(count)
    starts = np.arange(0, count, size)
    kept = [np.array([0, count - 1])]
    known = np.nan_to_num(signals)
    for column in known.T:
        padded = np.pad(column, (0, -count % size), mode="edge").reshape(-1, size)
        kept += [starts + padded.argmin(axis=1), starts + padded.argmax(axis=1)]
    return np.unique(np.minimum(np.concatenate(kept), count - 1))


def envelope(values: Array, buckets: int) -> tuple[Array, float, float]:
    """The smallest and the largest value of each bucket, in the order in which they occur.

    Returns the values (at most two a bucket), the position of the first value in samples, and the distance of two values in
    samples. A short signal keeps its samples. A bucket with a value that is not a number gives two such values.
    """
    count = len(values)
    size = -(-count // max(1, buckets))
    if size <= 2:
        return values, 0.0, 1.0
    parts = np.pad(values, (0, -count % size), mode="edge").reshape(-1, size)
    low, high = parts.min(axis=1), parts.max(axis=1)
    rising = parts.argmin(axis=1) <= parts.argmax(axis=1)
    pairs = np.column_stack([np.where(rising, low, high), np.where(rising, high, low)])
    return pairs.ravel(), (size - 1) / 4, size / 2
