"""The arithmetic of a move in the queue: runs get positions between those of their new neighbours."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from typing import Protocol


class Placed(Protocol):
    """A queued run as the arithmetic sees it."""

    @property
    def id(self) -> str: ...
    @property
    def priority(self) -> int: ...
    @property
    def position(self) -> float: ...


def moved(line: Sequence[Placed], runs: Sequence[str], index: int, priority: int, last: float) -> dict[str, tuple[int, float]]:
    """New priority and position of the runs, placed as a block before the run at `index` of the others in `line`.

    `priority` is that of the neighbour that the block was placed beside, because priorities start as a whole. New runs are
    placed at positions above `last`, so that the block stays before them. Where no number fits between two positions, every
    run gets a new position.
    """
    others = [one for one in line if one.id not in set(runs)]
    low = others[index - 1].position if index and others[index - 1].priority == priority else None
    high = others[index].position if index < len(others) and others[index].priority == priority else None
    if high is None:
        high = max(last, low or 0.0) + 1
    if low is None:
        low = high - len(runs) - 1
    step = (high - low) / (len(runs) + 1)
    positions = [low + step * (place + 1) for place in range(len(runs))]
    if all(first < second for first, second in itertools.pairwise([low, *positions, high])):
        return {run: (priority, position) for run, position in zip(runs, positions, strict=True)}
    priorities = {one.id: one.priority for one in others} | dict.fromkeys(runs, priority)
    renumbered = [*(one.id for one in others[:index]), *runs, *(one.id for one in others[index:])]
    return {run: (priorities[run], last - len(renumbered) + place + 1) for place, run in enumerate(renumbered)}
