"""Relations between two signals: v = dx/dt except for a factor, and the power f v of a device."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from functools import reduce
from typing import NamedTuple

import numpy as np
from scipy.ndimage import uniform_filter1d

from rths_engine.formats.scratch import on_disk, release
from rths_engine.foundation.arrays import Array
from rths_engine.recordings.measured.blocks import SHORT, parts

# chosen; see docs/decisions/0023
SAME = 1e-3  # of the range: rounding in the file
SMOOTHED = 9  # samples: smoothing removes the sampling noise of a derivative, not the motion of a test


class Relation(NamedTuple):
    """The relation b = factor * a and its correlation; both are zero where a or b is constant."""

    factor: float
    correlation: float


def of_derivative(x: Array, v: Array, dt: float) -> Relation:
    """The relation of v to dx/dt, both smoothed. Not valid for motion faster than a tenth of the sampling rate."""
    if len(x) < 4 * SMOOTHED:
        return Relation(0.0, 0.0)
    return _relation(_rates(x, v, dt))


def between(a: Array, b: Array) -> Relation:
    """The relation of b to a about their means, by least rectangles, which are least sensitive to noise on both."""
    return _relation((a[part], b[part]) for part in _parts(a, b))


def _parts(a: Array, b: Array) -> Iterator[slice]:
    """The blocks of two signals on disk, whose memory is freed after each; one block for signals in memory."""
    for part in parts(len(a), SHORT if on_disk(a) else max(1, len(a))):
        yield part
        release(a[part])
        release(b[part])


def _rates(x: Array, v: Array, dt: float) -> Iterator[tuple[Array, Array]]:
    """dx/dt and v, both smoothed, block by block; each block is computed with its neighbours' samples beside it."""
    for part in _parts(x, v):
        wide = slice(max(0, part.start - SMOOTHED), min(len(x), part.stop + SMOOTHED))
        inside = slice(part.start - wide.start, part.stop - wide.start)
        rate = uniform_filter1d(np.gradient(x[wide], dt), SMOOTHED)
        yield rate[inside], uniform_filter1d(v[wide], SMOOTHED)[inside]


def _relation(signals: Iterable[tuple[Array, Array]]) -> Relation:
    """The relation of two signals that are given block by block."""
    whole = reduce(_joined, (_moments(*block) for block in signals))
    power = whole.aa * whole.bb
    if not (np.isfinite(power) and power > 0):
        return Relation(0.0, 0.0)
    correlation = whole.ab / np.sqrt(power)
    return Relation(float(np.sign(correlation) * np.sqrt(whole.bb / whole.aa)), float(correlation))


class _Moments(NamedTuple):
    """Number, means, and sums of products about the means of a block of two signals."""

    samples: int
    mean_a: float
    mean_b: float
    aa: float
    bb: float
    ab: float


def _moments(a: Array, b: Array) -> _Moments:
    mean_a, mean_b = float(a.mean()), float(b.mean())
    a, b = a - mean_a, b - mean_b
    return _Moments(len(a), mean_a, mean_b, float(a @ a), float(b @ b), float(a @ b))


def _joined(first: _Moments, second: _Moments) -> _Moments:
    """The moments of two blocks together (Chan, Golub and LeVeque 1983, The American Statistician 37)."""
    count = first.samples + second.samples
    da, db = second.mean_a - first.mean_a, second.mean_b - first.mean_b
    share, weight = second.samples / count, first.samples * second.samples / count
    return _Moments(
        count,
        first.mean_a + share * da,
        first.mean_b + share * db,
        first.aa + second.aa + weight * da * da,
        first.bb + second.bb + weight * db * db,
        first.ab + second.ab + weight * da * db,
    )


def limited(asked: Array, given: Array) -> bool:
    """Whether `given` equals `asked`, clipped at the extremes of `given` or not clipped."""
    if len(asked) != len(given) or not (np.isfinite(asked).all() and np.isfinite(given).all()) or np.ptp(given) == 0:
        return False
    low, high = float(given.min()), float(given.max())
    return bool(np.max(np.abs(np.clip(asked, low, high) - given)) < SAME * (high - low))


def dissipated(x: Array, force: Array) -> float:
    """Share of the exchanged energy that the device takes, -1 to 1: sum(f dx) / sum(|f dx|), f about its mean."""
    mean = sum(float(force[part].sum()) for part in _parts(force, force)) / len(force)
    taken = exchanged = 0.0
    for part in _parts(x[:-1], force[:-1]):
        work = (force[part] - mean) * np.diff(x[part.start : part.stop + 1])
        taken += float(work.sum())
        exchanged += float(np.abs(work).sum())
    return taken / exchanged if exchanged > 0 else 0.0
