"""How probable the models tried are, and how sure their numbers."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rths_engine.arrays import Array
from rths_engine.diagnosis.fitting import Fitted
from rths_engine.part import Part
from rths_engine.physics.effect import Effect, Seen

NORMAL_90 = 1.6448536269514722  # standard deviations each way


MATERIAL = 0.02  # of all that effects account for: what models err by, so that less says little
STRONG = 6.0  # of BIC: strong evidence (Kass and Raftery 1995)


def weighed(tried: Sequence[Fitted], before: float, seen: Sequence[Seen]) -> list[float]:
    """chi^2 / T + k ln N of each, and what its effects' numbers are less likely beforehand. `before` is the BIC of the planned
    parts alone; T rises above 1 where MATERIAL of what the best model accounts for would be strong evidence: models err by as
    much, whatever the noise."""
    bic = [model.bic for model in tried]
    counts = [len(model.free) * float(np.log(model.samples)) for model in tried]
    temper = max(1.0, MATERIAL * (before - min(bic)) / STRONG)
    doubts = [sum(_doubt(part, seen) for part in model.parts) for model in tried]
    return [(one - count) / temper + count + doubt for one, count, doubt in zip(bic, counts, doubts, strict=True)]


def _doubt(part: Part, seen: Sequence[Seen]) -> float:
    return part.doubt(seen[getattr(part, "storey", 1) - 1]) if isinstance(part, Effect) else 0.0


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
