"""Is there more in the residual than noise: by parametric bootstrap of the largest score over the library."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.stats import gumbel_r

from rths_engine.arrays import Array
from rths_engine.diagnosis.fitting import Fitted, Recordings
from rths_engine.diagnosis.signatures import Signatures, absorber

REPLICATES = 99


@dataclass(frozen=True)
class Detection:
    """The scores of the signatures, the largest, and how probable one as large is where nothing was left out."""

    scores: Array
    largest: float
    p_value: float


def detect(recordings: Recordings, fitted: Fitted, found: Signatures, random: np.random.Generator) -> Detection:
    """By recordings simulated with the fitted model: noise of the recording's colour on the output, and of the
    displacement's size on the input, taken through the same smoothing, model and band. Each score is told in standard
    deviations of its own under that noise, which reaches some signatures more than others."""
    raw = found.scores(fitted_residual(recordings, fitted))
    if not len(raw):
        return Detection(raw, 0.0, 1.0)
    null = np.array([found.scores(one) for one in _null_misfits(recordings, fitted, random)])
    centre, spread = null.mean(axis=0), np.maximum(null.std(axis=0), 1e-3)
    scores = (raw - centre) / spread
    largest = float(scores.max())
    return Detection(scores, largest, p_value(largest, ((null - centre) / spread).max(axis=1)))


def fitted_residual(recordings: Recordings, fitted: Fitted) -> Array:
    absorbed = absorber(fitted.jacobian)
    misfit = fitted.misfit
    left: Array = misfit - absorbed @ (absorbed.T @ misfit)
    return left


def p_value(largest: float, null: Array) -> float:
    """Of the replicates where they reach that far, else of the extreme-value law through them."""
    beyond = int(np.sum(null >= largest))
    if beyond >= 5:
        return (1 + beyond) / (1 + len(null))
    location, scale = gumbel_r.fit(null)
    return max(float(gumbel_r.sf(largest, location, scale)), 1e-300)


def _null_misfits(recordings: Recordings, fitted: Fitted, random: np.random.Generator) -> list[Array]:
    absorbed = absorber(fitted.jacobian)
    component = recordings.component
    before = [component.predicted(fitted.parts, one) for one in recordings.data]
    found: list[Array] = []
    for _ in range(REPLICATES):
        drawn = []
        for one, plain in zip(recordings.data, before, strict=True):
            noise = recordings.noise.drawn(len(plain), random)
            if one.x_noise > 0:
                noise = noise + plain - component.predicted(fitted.parts, one, one.noisy(random))
            drawn.append(noise)
        misfit = recordings.joined(drawn)
        found.append(misfit - absorbed @ (absorbed.T @ misfit))
    return found
