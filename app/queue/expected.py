"""Expected times: the time of a test from its pace or from earlier tests alike, and a schedule of the queue from these."""

from __future__ import annotations

import heapq
from collections.abc import Callable, Mapping, Sequence
from statistics import median
from typing import NamedTuple, Protocol

from app.queue.repository import Earlier

LATEST = 9  # earlier tests whose median counts
UNKNOWN = "no earlier test alike has ended"


class Expected(NamedTuple):
    """The expected time (s) of a test, None where it is not known, and what it follows from."""

    time_s: float | None
    source: str


class Span(NamedTuple):
    """The expected start and end of a test, s from now; None where it is not known."""

    start_s: float | None
    end_s: float | None


class Test(Protocol):
    """What the expected time of a test follows from."""

    @property
    def pace(self) -> float | None: ...
    @property
    def duration_s(self) -> float: ...
    @property
    def digest(self) -> str: ...
    @property
    def size(self) -> str | None: ...
    @property
    def samples(self) -> int | None: ...
    @property
    def rig_id(self) -> str: ...


class Speeds:
    """Times of earlier tests, for the expected times of others."""

    def __init__(self, earlier: Sequence[Earlier], busy: bool):
        """`busy`: whether other tests will run at the same time. Earlier tests that ran so are preferred."""
        self.fastest = [one for one in earlier if one.pace is None]
        self.around = median([one.wall_s - one.elapsed_s for one in earlier[:LATEST]] or [0.0])
        self.busy = busy

    def of(self, test: Test) -> Expected:
        """The expected time of a test: planned for a pace, else measured on earlier tests alike."""
        if test.size is None:
            return Expected(None, "the test was queued by an earlier version of this program")
        if test.pace is not None:
            return Expected(test.duration_s / test.pace + self.around, "the planned pace")
        samples = test.samples or 0
        whole = self._median(lambda one: one.digest == test.digest, lambda one: one.wall_s, test.rig_id)
        if whole is not None:
            return Expected(whole, "earlier tests of this plan")
        rate = self._median(lambda one: one.size == test.size, _per_sample, test.rig_id)
        if rate is not None:
            return Expected(rate * samples, "the speed of earlier tests of this size")
        rate = self._median(lambda one: True, _per_sample, test.rig_id)
        if rate is not None:
            return Expected(rate * samples, "the speed of earlier tests of other sizes")
        return Expected(None, UNKNOWN)

    def _median(self, alike: Callable[[Earlier], bool], value: Callable[[Earlier], float], rig: str) -> float | None:
        """The median over the latest tests alike, on the same rig and as busy where there are any."""
        found = [one for one in self.fastest if alike(one)]
        found = [one for one in found if one.rig_id == rig] or found
        found = [one for one in found if ((one.beside or 0) > 0) == self.busy] or found
        return median(value(one) for one in found[:LATEST]) if found else None


def _per_sample(one: Earlier) -> float:
    return one.wall_s / max(one.samples or 1, 1)


def schedule(
    running: Sequence[tuple[str, float | None]],
    waiting: Sequence[tuple[str, float | None]],
    places: int,
    rigs: Mapping[str, int | None],
) -> list[Span]:
    """When each waiting test starts and ends, as a turn of the queue chooses: the first test whose rig is free.

    Tests are (rig, time in s): the time left of a running test, the whole time of a waiting one. After a test whose time is not
    known nothing is known.
    """
    spans = [Span(None, None)] * len(waiting)
    if places < 1 or any(left is None for _, left in running):
        return spans
    ends = [(left or 0.0, rig) for rig, left in running]
    heapq.heapify(ends)
    on: dict[str, int] = {}
    for _, rig in ends:
        on[rig] = on.get(rig, 0) + 1
    left = list(range(len(waiting)))
    now = 0.0
    while left:
        first = next((k for k in left if not _full(waiting[k][0], rigs, on)), None) if len(ends) < places else None
        if first is None:
            if not ends:
                break  # its rig takes no test
            now, rig = heapq.heappop(ends)
            on[rig] -= 1
            continue
        rig, time_s = waiting[first]
        left.remove(first)
        if time_s is None:
            spans[first] = Span(now, None)
            break
        spans[first] = Span(now, now + time_s)
        heapq.heappush(ends, (now + time_s, rig))
        on[rig] = on.get(rig, 0) + 1
    return spans


def _full(rig: str, rigs: Mapping[str, int | None], on: Mapping[str, int]) -> bool:
    most = rigs.get(rig)
    return most is not None and on.get(rig, 0) >= most
