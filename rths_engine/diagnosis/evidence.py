"""How probable the models tried are, and how sure their numbers."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rths_engine.arrays import Array
from rths_engine.diagnosis.fitting import Fitted

NORMAL_90 = 1.6448536269514722  # standard deviations each way


MATERIAL = 0.02  # of all that effects account for: models nearer than that are told apart by their numbers alone


def weighed(tried: Sequence[Fitted], before: float) -> list[float]:
    """BIC of each, where models err too: `before` is that of the planned parts alone. Models that account for nearly as much as
    the best are alike but for ln N for each of their numbers."""
    bic = [model.bic for model in tried]
    level = min(bic) + MATERIAL * max(0.0, before - min(bic))
    counts = [len(model.free) * float(np.log(model.samples)) for model in tried]
    least = min(count for count, one in zip(counts, bic, strict=True) if one <= level)
    return [max(one, level + count - least) for one, count in zip(bic, counts, strict=True)]


def probabilities(weights: Sequence[float]) -> list[float]:
    """exp(-BIC/2) over their sum: equal chances beforehand. Source: Kass and Raftery (1995), JASA 90, 773-795."""
    bic = np.array(weights)
    chances = np.exp(-(bic - bic.min()) / 2)
    return [float(one) for one in chances / chances.sum()]


def deviations(fitted: Fitted, misfits: Array) -> Array:
    """Standard deviation of each free number's z, by what the fit to first order makes of other noise: `misfits` (B, N)."""
    moved = np.linalg.lstsq(fitted.jacobian, misfits.T, rcond=None)[0]
    found: Array = np.std(moved, axis=1, ddof=1)
    return found


def intervals(fitted: Fitted, deviations: Array) -> list[tuple[float, float]]:
    """90 % interval of each free number."""
    spread = NORMAL_90 * deviations
    ends = zip(fitted.free, fitted.z - spread, fitted.z + spread, strict=True)
    return [(number.from_z(low), number.from_z(high)) for number, low, high in ends]
