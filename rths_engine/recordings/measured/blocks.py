"""Arithmetic on a channel block by block: in the processor's cache, and with little memory for a channel in a file."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from typing import NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from rths_engine.formats.scratch import Scratch, on_disk, release
from rths_engine.foundation.arrays import Array

# chosen; see docs/decisions/0023
BLOCK = 1 << 15  # samples
SHORT = 1 << 13  # samples of blocks whose products are summed: from 10 000 on, BLAS starts threads that wait for each other
THREADS = 2

Given = TypeVar("Given")
Result = TypeVar("Result")


class Extent(NamedTuple):
    """The smallest and the largest value of a channel, and how many samples have it; NaN where a sample is NaN."""

    low: float
    high: float
    at_low: int
    at_high: int

    @property
    def finite(self) -> bool:
        return bool(np.isfinite(self.low) and np.isfinite(self.high))


def parts(count: int, size: int = BLOCK) -> Iterator[slice]:
    """The places of `count` samples, block by block."""
    return (slice(first, min(first + size, count)) for first in range(0, count, size))


def extent(values: Array) -> Extent:
    """The extent of a channel with at least one sample."""
    found = _Extremes()
    for part in parts(len(values)):
        found.add(values[part])
        release(values[part])
    return found.extent()


def equal(values: Array, level: float) -> NDArray[np.bool_]:
    """Which samples have exactly the value `level`."""
    found = np.empty(len(values), dtype=bool)
    for part in parts(len(values)):
        found[part] = values[part] == level
        release(values[part])
    return found


def scaled(values: Array, factor: float, offset: float, zero: float) -> tuple[Array, Extent]:
    """Factor * (values - offset) + zero and its extent; on disk where `values` are."""
    if not on_disk(values):
        found = factor * (values - offset) + zero
        return found, extent(found)
    extremes = _Extremes()
    with Scratch(1, len(values)) as scratch:
        for part in parts(len(values)):
            block = np.subtract(values[part], offset)
            release(values[part])
            block *= factor
            block += zero
            extremes.add(block)
            scratch.write(0, part.start, block)
        return scratch.columns(len(values))[0], extremes.extent()


def each(work: Callable[[Given], Result], given: list[Given], threads: bool) -> list[Result]:
    """The results in order; `threads` for channels on disk, whose arithmetic does not hold Python's lock."""
    if not threads:
        return list(map(work, given))
    with ThreadPoolExecutor(THREADS) as pool:
        return list(pool.map(work, given))


class _Extremes:
    """The smallest and the largest value of the blocks so far, and how often they occur."""

    def __init__(self) -> None:
        self._low, self._high, self._at_low, self._at_high = np.inf, -np.inf, 0, 0

    def add(self, block: Array) -> None:
        low, high = float(block.min()), float(block.max())
        if not (low > self._low or np.isnan(self._low)):
            self._at_low = int(np.count_nonzero(block == low)) + (self._at_low if low == self._low else 0)
            self._low = low
        if not (high < self._high or np.isnan(self._high)):
            self._at_high = int(np.count_nonzero(block == high)) + (self._at_high if high == self._high else 0)
            self._high = high

    def extent(self) -> Extent:
        return Extent(self._low, self._high, self._at_low, self._at_high)
