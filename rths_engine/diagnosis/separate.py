"""Separation of two models by a recording: the squared distance lambda of their simulations in units of the noise."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rths_engine.diagnosis.fitting import Fitted, Recordings
from rths_engine.foundation.part import Part

# chosen; see docs/decisions/0023
APART = 10.0  # the least lambda that separates two models


def separation(recordings: Recordings, one: Sequence[Part], other: Sequence[Part]) -> float:
    """Lambda between two models: the squared distance of their simulations in units of the noise.

    lambda = N_eff (misfit of one to the other / sigma)^2.
    """
    pairs = zip(recordings.predicted(one), recordings.predicted(other), strict=True)
    between = recordings.joined([first - second for first, second in pairs])
    return float(between @ between)


def alike(recordings: Recordings, best: Fitted, tried: tuple[Fitted, ...]) -> list[tuple[Fitted, float]]:
    """The models that the recording does not separate from the best, each with its lambda; they have equally many effects."""
    found = []
    for other in tried:
        if other is not best and len(other.parts) == len(best.parts) and other.bic - best.bic < APART:
            apart = separation(recordings, best.parts, other.parts)
            if np.isfinite(apart) and apart < APART:
                found.append((other, apart))
    return found
