"""Separation of two models by a recording: the squared distance lambda of their simulations in units of the noise."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rths_engine.diagnosis.fitting import Fitted, Recordings
from rths_engine.foundation.part import Part

# chosen; see docs/decisions/0023
APART = 10.0  # the least lambda that separates two models
LIKELY = 0.1  # of the probability of the best model: a rival above it is not excluded, whatever their lambda


def separation(recordings: Recordings, one: Sequence[Part], other: Sequence[Part]) -> float:
    """Lambda between two models: the squared distance of their simulations in units of the noise.

    lambda = N_eff (misfit of one to the other / sigma)^2.
    """
    pairs = zip(recordings.predicted(one), recordings.predicted(other), strict=True)
    between = recordings.joined([first - second for first, second in pairs])
    return float(between @ between)


def alike(
    recordings: Recordings, best: Fitted, tried: Sequence[Fitted], chances: Sequence[float] = ()
) -> list[tuple[Fitted, float]]:
    """The models that the recording does not separate from the best, each with its lambda; they have equally many effects.

    These are the models with a lambda below APART and nearly the same BIC. A model whose probability in `chances`, one for
    each of `tried`, is above LIKELY times that of the best belongs to them whatever its lambda is: models of measured tests
    have errors beyond the noise, which lambda does not count.
    """
    likely = {id(model): chance for model, chance in zip(tried, chances, strict=False)}
    found = []
    for other in tried:
        possible = likely.get(id(other), 0.0) > LIKELY * likely.get(id(best), 1.0)
        if other is best or len(other.parts) != len(best.parts) or not (possible or other.bic - best.bic < APART):
            continue
        apart = separation(recordings, best.parts, other.parts)
        if np.isfinite(apart) and (possible or apart < APART):
            found.append((other, apart))
    return found
