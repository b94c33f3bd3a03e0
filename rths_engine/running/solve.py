"""Solve with a sparse factor, compiled."""

from __future__ import annotations

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.factor import Factor
from rths_engine.foundation.kernel import entry, piece


@piece
def solve(factor: Factor, right: Array, work: Array, result: Array) -> None:
    """Solve a factored system: result = inv(A) @ right.

    `work` has as many numbers as `right`, which is not changed.
    """
    count = right.size
    for k in range(count):
        work[k] = right[factor.order[k]]
    for k in range(count):
        known = work[k]
        for at in range(factor.start[k], factor.start[k + 1]):
            work[factor.row[at]] -= factor.value[at] * known
    for k in range(count - 1, -1, -1):
        total = work[k] * factor.pivot_inverse[k]
        for at in range(factor.start[k], factor.start[k + 1]):
            total -= factor.value[at] * work[factor.row[at]]
        work[k] = total
    for k in range(count):
        result[factor.order[k]] = work[k]


@entry
def solve_rows(factor: Factor, right: Array, work: Array, result: Array) -> None:
    """Solve a factored system for every row: result = right @ inv(A). `right` and `result` (rows, n), `work` (n)."""
    for row in range(right.shape[0]):
        solve(factor, right[row], work, result[row])
