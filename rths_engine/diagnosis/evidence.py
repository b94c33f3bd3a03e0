"""How probable the models tried are, and how sure their numbers."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rths_engine.diagnosis.fitting import Fitted
from rths_engine.foundation.part import Part
from rths_engine.parts import physics
from rths_engine.parts.physics.effect import Effect
from rths_engine.parts.physics.search import Seen

# chosen; see docs/decisions/0023
MATERIAL = 0.02  # of all that effects account for: what models err by, so that less says little
STRONG = 6.0  # of BIC: strong evidence (Kass and Raftery 1995)


def weighed(tried: Sequence[Fitted], before: float, seen: Sequence[Seen]) -> list[float]:
    """Evidence of each model: chi^2 / T + k ln N, and the prior odds of its effects' numbers.

    `before` is the BIC of the planned parts alone. T rises above 1 where MATERIAL of what the best model accounts for would be
    strong evidence: models err by as much, whatever the noise.
    """
    bic = [model.bic for model in tried]
    counts = [len(model.free) * float(np.log(model.samples)) for model in tried]
    temper = tempering(min(bic), before)
    doubts = [sum(_doubt(part, seen) for part in model.parts) for model in tried]
    return [(one - count) / temper + count + doubt for one, count, doubt in zip(bic, counts, doubts, strict=True)]


def tempering(best: float, before: float) -> float:
    """T, from the BIC of the best model and that of the planned parts."""
    return max(1.0, MATERIAL * (before - best) / STRONG)


def _doubt(part: Part, seen: Sequence[Seen]) -> float:
    if not isinstance(part, Effect):
        return 0.0
    return physics.SEARCHES[type(part)].doubt(part, seen[getattr(part, "storey", 1) - 1])


def probabilities(weights: Sequence[float]) -> list[float]:
    """exp(-BIC/2) over their sum: equal chances beforehand. Source: Kass and Raftery (1995), JASA 90, 773-795."""
    bic = np.array(weights)
    chances = np.exp(-(bic - bic.min()) / 2)
    return [float(one) for one in chances / chances.sum()]
