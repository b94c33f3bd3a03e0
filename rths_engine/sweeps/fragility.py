"""Probability that a measure exceeds a level, against an intensity: P(exceed | x) = Phi(ln(x / theta) / beta).

theta is the median intensity and beta the dispersion, both by maximum likelihood over the points, of which each exceeds or not.
Source: Baker (2015), Earthquake Spectra 31, 579-599, equation (11). It assumes that the points are independent, and that
ln x of the intensity at which a test exceeds the level is normally distributed.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from scipy.special import log_ndtr, ndtr, ndtri

from rths_engine.foundation.arrays import Array

# chosen; see docs/decisions/0023
MOST_LEVELS = 25  # distinct intensities that are shown as they are; more are put into parts
PARTS = 10
CURVE = 80  # points of the fitted curve
STEPS = 60  # of Newton's method
SMALL_STEP = 1e-10


@dataclass(frozen=True, slots=True)
class Empirical:
    """Points of one intensity, or of a part of the intensities: mean intensity, number of points, and how many exceed."""

    intensity: float
    points: int
    exceeding: int


@dataclass(frozen=True, slots=True)
class Fragility:
    """Median and dispersion, with their curve; None where they cannot be determined, and `reason` says why."""

    median: float | None
    dispersion: float | None
    reason: str
    intensities: tuple[float, ...]
    probabilities: tuple[float, ...]
    empirical: tuple[Empirical, ...]
    points: int
    exceeding: int


def fragility(intensity: Array, exceeds: Array) -> Fragility:
    """The fragility curve of points with positive `intensity` (n) and whether each `exceeds` (n, bool)."""
    order = np.argsort(intensity, kind="stable")
    x, exceeding = intensity[order], exceeds[order].astype(bool)
    shares = _empirical(x, exceeding)
    about = (shares, len(x), int(exceeding.sum()))
    if not exceeding.any() or exceeding.all():
        which = "No point exceeds" if not exceeding.any() else "Every point exceeds"
        return Fragility(None, None, f"{which} the level: there is no curve to fit.", (), (), *about)
    if x[0] == x[-1]:
        return Fragility(None, None, "All points have one intensity: there is no curve to fit.", (), (), *about)
    if x[~exceeding].max() < x[exceeding].min():
        reason = (
            "Every point above one intensity exceeds the level and none below it: the dispersion is too small to determine."
        )
        return Fragility(None, None, reason, (), (), *about)
    a, b = _fitted(np.log(x), exceeding)
    if b <= 0:
        return Fragility(None, None, "The probability does not grow with the intensity: no curve was fitted.", (), (), *about)
    low, high = np.exp((ndtri(0.001) - a) / b), np.exp((ndtri(0.999) - a) / b)
    at = np.geomspace(max(min(low, x[0]), x[0] / 10), min(max(high, x[-1]), x[-1] * 10), CURVE)
    curve = ndtr(a + b * np.log(at))
    return Fragility(float(np.exp(-a / b)), float(1 / b), "", tuple(at.tolist()), tuple(curve.tolist()), *about)


def _fitted(log_x: Array, exceeding: Array) -> tuple[float, float]:
    """A and b of Phi(a + b ln x) by Newton's method on the log likelihood, which is concave."""
    centre, spread = float(np.mean(log_x)), float(np.std(log_x))
    z = (log_x - centre) / spread
    design, signs = np.column_stack([np.ones_like(z), z]), np.where(exceeding, 1.0, -1.0)
    found = np.zeros(2)
    for _ in range(STEPS):
        index = signs * (design @ found)
        ratio = np.exp(-0.5 * index**2 - 0.5 * np.log(2 * np.pi) - log_ndtr(index))  # phi / Phi
        slope = design.T @ (signs * ratio)
        bend = (design * (ratio * (index + ratio))[:, None]).T @ design
        step = np.linalg.solve(bend + 1e-12 * np.eye(2), slope)
        found = found + step * min(1.0, 5.0 / max(float(np.max(np.abs(step))), 1e-300))
        if np.max(np.abs(step)) < SMALL_STEP:
            break
    return float(found[0] - found[1] * centre / spread), float(found[1] / spread)


def _empirical(x: Array, exceeding: Array) -> tuple[Empirical, ...]:
    """Shares at each intensity, or in parts of equally many points where there are many intensities."""
    levels = np.unique(x)
    if len(levels) <= MOST_LEVELS:
        groups = [x == level for level in levels]
    else:
        edges = np.linspace(0, len(x), min(PARTS, len(x)) + 1).astype(int)
        groups = [(np.arange(len(x)) >= first) & (np.arange(len(x)) < last) for first, last in pairwise(edges)]
    return tuple(
        Empirical(float(x[one].min() if np.ptp(x[one]) == 0 else np.mean(x[one])), int(one.sum()), int(exceeding[one].sum()))
        for one in groups
        if one.any()
    )
