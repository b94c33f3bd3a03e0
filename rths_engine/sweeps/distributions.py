"""Distributions of a varied field: x = F^-1(F(a) + u (F(b) - F(a))), truncated at a and b, for a cumulative share u in (0, 1).

Uniform, normal and lognormal (the normal distribution of ln x). a and b are the ends that the definition states, and within
them the bounds of the field, so that no point breaks a bound. What the truncation cuts off is said.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.special import ndtr, ndtri

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import Issue, PlanError
from rths_engine.sweeps.definition import Lognormal, Normal, Uniform
from rths_engine.sweeps.places import in_words

# chosen; see docs/decisions/0023
LEAST_LEFT = 0.01  # of the probability; a distribution that its ends leave less of is not the one that was meant
SAID = 0.0005  # of the probability; less is not worth a note


@dataclass(frozen=True, slots=True)
class Law:
    """A truncated distribution: location and scale of x or, with `log`, of ln x; None: uniform. `note`: what is cut."""

    location: float
    scale: float | None
    low: float
    high: float
    log: bool = False
    note: str | None = None

    def at(self, share: Array) -> Array:
        """The values at cumulative probabilities `share` (n) of the truncated distribution."""
        if self.scale is None:
            evenly: Array = np.minimum(self.low + share * (self.high - self.low), self.high)
            return evenly
        first, last = (self._below(end) for end in (self.low, self.high))
        found = self.location + self.scale * ndtri(first + share * (last - first))
        values: Array = np.clip(np.exp(found) if self.log else found, self.low, self.high)
        return values

    def _below(self, value: float) -> float:
        """The probability of values below `value`, without truncation."""
        if self.log:
            value = math.log(value) if value > 0 else -math.inf
        assert self.scale is not None
        return float(ndtr((value - self.location) / self.scale))

    @property
    def left(self) -> float:
        """The share of the distribution that the truncation leaves."""
        return 1.0 if self.scale is None else self._below(self.high) - self._below(self.low)


def law(
    given: Uniform | Normal | Lognormal,
    number: Callable[[Any, str], float],
    bounds: tuple[float, float],
    shown: str,
    where: str,
) -> Law:
    """The distribution in SI. `number` reads one of its numbers; `bounds` are those of the field. Raises PlanError."""
    low, high = bounds
    ends = [None if value is None else number(value, name) for name, value in (("lower", given.lower), ("upper", given.upper))]
    for name, end, written in zip(("lower", "upper"), ends, (given.lower, given.upper), strict=True):
        if end is not None and not low <= end <= high:
            problem = f"is outside the bounds of the field, {_span(low, high, shown)}"
            raise PlanError(Issue(f"{where}.{name}", problem, written))
    own = ends[0] is not None or ends[1] is not None
    low, high = (bound if end is None else end for bound, end in zip(bounds, ends, strict=True))
    if not low < high:
        raise PlanError(Issue(f"{where}.upper", "needs a value above the lower end", given.upper))
    if isinstance(given, Uniform):
        return Law(0.0, None, low, high)
    if isinstance(given, Normal):
        spread = number(given.sd, "sd")
        if spread <= 0:
            raise PlanError(Issue(f"{where}.sd", "needs a value > 0", given.sd))
        found = Law(number(given.mean, "mean"), spread, low, high)
    else:
        median = number(given.median, "median")
        if median <= 0:
            raise PlanError(Issue(f"{where}.median", "needs a value > 0", given.median))
        found = Law(math.log(median), given.sigma_ln, low, high, log=True)
    return _said(found, own, shown, where)


def _said(found: Law, own: bool, shown: str, where: str) -> Law:
    """The distribution with its note. Raises PlanError where the truncation leaves almost nothing."""
    cut = 1.0 - found.left
    whose = "the ends that are stated and by the bounds of the field" if own else "the bounds of the field"
    span = _span(found.low, found.high, shown)
    if found.left < LEAST_LEFT:
        problem = f"has only {100 * found.left:.2g} % of its probability between its ends, {span}"
        raise PlanError(Issue(where, problem, fix="move the distribution or its ends"))
    if cut < SAID:
        return found
    note = f"truncated to {span} by {whose}: {100 * cut:.2g} % of its probability is cut off"
    return Law(found.location, found.scale, found.low, found.high, found.log, note)


def _span(low: float, high: float, shown: str) -> str:
    if math.isinf(high):
        return f"at least {in_words(low, shown)}" if math.isfinite(low) else "any number"
    return f"{in_words(low, shown)} to {in_words(high, shown)}" if math.isfinite(low) else f"at most {in_words(high, shown)}"
