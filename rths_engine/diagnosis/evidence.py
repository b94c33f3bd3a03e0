"""Evidence and probabilities of the fitted models."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rths_engine.diagnosis.fitting import Fitted
from rths_engine.foundation.part import Part
from rths_engine.parts import physics
from rths_engine.parts.physics.effect import Effect
from rths_engine.parts.physics.search import Seen

# chosen; see docs/decisions/0023
MATERIAL = 0.02  # of the chi^2 that effects explain: the error of models, below which evidence is weak
STRONG = 6.0  # difference of BIC: strong evidence (Kass and Raftery 1995)


def weighed(tried: Sequence[Fitted], before: float, seen: Sequence[Seen]) -> list[float]:
    """Evidence of each model: chi^2 / T + k ln N - 2 ln(prior odds); the smallest is the best.

    `tried` are the fitted models, `before` is the BIC of the planned parts alone, and `seen` holds the sizes for the prior
    odds. T is the tempering: models have errors of MATERIAL whatever the noise is.
    """
    bic = [model.bic for model in tried]
    counts = [len(model.free) * float(np.log(model.samples)) for model in tried]
    temper = tempering(min(bic), before)
    priors = [sum(_prior(part, seen) for part in model.parts) for model in tried]
    return [(one - count) / temper + count + prior for one, count, prior in zip(bic, counts, priors, strict=True)]


def tempering(best: float, before: float) -> float:
    """T = max(1, MATERIAL * G / STRONG), where G is the BIC of the planned parts `before` minus that of the `best` model."""
    return max(1.0, MATERIAL * (before - best) / STRONG)


def _prior(part: Part, seen: Sequence[Seen]) -> float:
    """-2 ln of the prior odds of an effect; 0 for a planned part."""
    if not isinstance(part, Effect):
        return 0.0
    return physics.SEARCHES[type(part)].doubt(part, seen[getattr(part, "storey", 1) - 1])


def probabilities(weights: Sequence[float]) -> list[float]:
    """Probabilities of the models, exp(-E/2) over their sum, from evidences E that include the prior odds.

    Source: Kass and Raftery (1995), JASA 90, 773-795.
    """
    bic = np.array(weights)
    chances = np.exp(-(bic - bic.min()) / 2)
    return [float(one) for one in chances / chances.sum()]
