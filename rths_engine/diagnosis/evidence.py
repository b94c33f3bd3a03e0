"""How probable the models tried are, and how sure their numbers."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rths_engine.diagnosis.fitting import Fitted

NORMAL_90 = 1.6448536269514722  # standard deviations each way


def probabilities(tried: Sequence[Fitted]) -> list[float]:
    """exp(-BIC/2) over their sum: equal chances beforehand. Source: Kass and Raftery (1995), JASA 90, 773-795."""
    bic = np.array([model.bic for model in tried])
    weights = np.exp(-(bic - bic.min()) / 2)
    return [float(one) for one in weights / weights.sum()]


def intervals(fitted: Fitted) -> list[tuple[float, float]]:
    """90 % interval of each free number, from inv(J^T J) times the misfit's variance."""
    if not fitted.free:
        return []
    freedom = max(1, len(fitted.misfit) - len(fitted.free))
    covariance = np.linalg.pinv(fitted.jacobian.T @ fitted.jacobian) * fitted.squared / freedom
    spread = NORMAL_90 * np.sqrt(np.diagonal(covariance))
    ends = zip(fitted.free, fitted.z - spread, fitted.z + spread, strict=True)
    return [(number.from_z(low), number.from_z(high)) for number, low, high in ends]
