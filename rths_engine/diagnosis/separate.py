"""How well two models can be told apart: on the recording, and by another test."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rths_engine.diagnosis.fitting import Fitted, Recordings
from rths_engine.foundation.part import Part

# chosen; see docs/decisions/0023
APART = 10.0  # of lambda: below, two models can't be told apart


def separation(recordings: Recordings, one: Sequence[Part], other: Sequence[Part]) -> float:
    """Squared distance of what two models simulate, in units of the noise.

    lambda = N_eff (misfit of one to the other / sigma)^2.
    """
    pairs = zip(recordings.predicted(one), recordings.predicted(other), strict=True)
    between = recordings.joined([first - second for first, second in pairs])
    return float(between @ between)


def alike(recordings: Recordings, best: Fitted, tried: tuple[Fitted, ...]) -> list[tuple[Fitted, float]]:
    """Models of as many effects that can't be told from the best, with their lambda."""
    found = []
    for other in tried:
        if other is not best and len(other.parts) == len(best.parts) and other.bic - best.bic < APART:
            apart = separation(recordings, best.parts, other.parts)
            if np.isfinite(apart) and apart < APART:
                found.append((other, apart))
    return found
