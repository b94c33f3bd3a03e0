"""Solve with a sparse factor, compiled."""

from __future__ import annotations

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.factor import Factor
from rths_engine.foundation.kernel import compiled


@compiled
def solve(factor: Factor, right: Array, work: Array, result: Array) -> None:
    """Solve a factored system: result = inv(A) @ right.

    `work` has as many numbers as `right`, which is not changed.
    """
    count = right.size
    for k in range(count):
        work[k] = right[factor.order[k]]
    for k in range(count):
        known = work[k]
        for entry in range(factor.start[k], factor.start[k + 1]):
            work[factor.row[entry]] -= factor.value[entry] * known
    for k in range(count - 1, -1, -1):
        total = work[k] * factor.pivot_inverse[k]
        for entry in range(factor.start[k], factor.start[k + 1]):
            total -= factor.value[entry] * work[factor.row[entry]]
        work[k] = total
    for k in range(count):
        result[factor.order[k]] = work[k]
