"""Work side by side."""

from __future__ import annotations

import os
from threading import Barrier

import pytest

from rths_engine.diagnosis.parallel import each


def test_results_come_in_the_order_of_what_was_given() -> None:
    assert each(lambda one: one * one, range(50)) == [one * one for one in range(50)]
    assert each(lambda one: one, []) == []


def test_an_error_of_the_work_is_raised_where_it_was_asked_for() -> None:
    with pytest.raises(ZeroDivisionError):
        each(lambda one: 1 / one, [2, 1, 0])


@pytest.mark.skipif(len(os.sched_getaffinity(0)) < 2, reason="one core")
def test_as_many_are_worked_on_at_once_as_there_are_cores() -> None:
    """Each waits for the others: one after another they would break the barrier."""
    count = len(os.sched_getaffinity(0))
    together = Barrier(count, timeout=60)
    assert sorted(each(lambda _: together.wait(), range(count))) == list(range(count))
