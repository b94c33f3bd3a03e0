"""How strongly a measure depends on each input of a sweep: the bars of a tornado diagram, and rank correlations.

A bar spans the mean of the measure over the points with low values of the input and over those with high values: the lowest and
the highest value where there are few, else the lowest and the highest third. In a sweep of one field at a time, only the points
in which the other inputs are as planned count. The rank correlation (Spearman) is -1 to 1.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rths_engine.foundation.arrays import Array

# chosen; see docs/decisions/0023
FEW = 12  # values of an input of which the lowest and the highest are compared, not thirds
FEWEST = 2  # points with a value, without which there is no bar


@dataclass(frozen=True, slots=True)
class Bar:
    """One input: mean of the measure at its low and at its high end, the mean input there, and the rank correlation."""

    place: int
    low: float
    high: float
    low_input: float
    high_input: float
    correlation: float | None

    @property
    def span(self) -> float:
        return abs(self.high - self.low)


def bars(inputs: Array, measure: Array, planned: Sequence[float] | None = None) -> list[Bar]:
    """A bar for each input (points, inputs) that varies, the longest first; `measure` (points) may have NaN.

    `planned` holds the inputs of the plan itself in a sweep of one field at a time, where each bar uses its own points only.
    """
    known = np.isfinite(measure)
    found = []
    for place in range(inputs.shape[1]):
        used = known & np.isfinite(inputs[:, place])
        if planned is not None:
            others = [k for k in range(inputs.shape[1]) if k != place]
            used &= np.all(inputs[:, others] == np.asarray(planned)[others], axis=1)
        bar = _bar(place, inputs[used, place], measure[used])
        if bar:
            found.append(bar)
    return sorted(found, key=lambda one: -one.span)


def _bar(place: int, x: Array, y: Array) -> Bar | None:
    if len(x) < FEWEST or x.min() == x.max():
        return None
    from scipy.stats import rankdata

    levels = np.unique(x)
    ends = (levels[0], levels[-1]) if len(levels) <= FEW else (np.quantile(x, 1 / 3), np.quantile(x, 2 / 3))
    low, high = x <= ends[0], x >= ends[1]
    correlation = float(np.corrcoef(rankdata(x), rankdata(y))[0, 1]) if y.min() < y.max() else None
    y_low, y_high, x_low, x_high = (float(np.mean(one)) for one in (y[low], y[high], x[low], x[high]))
    return Bar(place, y_low, y_high, x_low, x_high, correlation)
