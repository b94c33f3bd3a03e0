"""Replays in parallel threads; the compiled loops release Python's global lock."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable
from concurrent.futures import ThreadPoolExecutor
from typing import TypeVar

Given = TypeVar("Given")
Found = TypeVar("Found")
_POOL = ThreadPoolExecutor(max(1, len(os.sched_getaffinity(0))))


def each(work: Callable[[Given], Found], given: Iterable[Given]) -> list[Found]:
    """The results of `work` for each item, in order. `work` itself must not call this function."""
    return list(_POOL.map(work, given))
