"""Is there more in the residual than noise: by parametric bootstrap of the largest score over the library, and of what any
law of motion, energy and time could account for."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.stats import gamma, gumbel_r

from rths_engine.arrays import Array
from rths_engine.diagnosis.fitting import Fitted, Recordings
from rths_engine.diagnosis.parallel import each
from rths_engine.diagnosis.signatures import Signatures, absorber

REPLICATES = 99
TINIEST = 1e-300


@dataclass(frozen=True)
class Detection:
    """Scores of the signatures, the largest, and how probable one as large is where nothing was left out; the same of the
    general law's squared length, with the expected length without one."""

    scores: Array
    largest: float
    p_library: float
    p_general: float
    explained: float  # squared length that a general law accounts for
    expected: float

    @property
    def p_value(self) -> float:
        """Of either test."""
        return min(1.0, 2 * min(self.p_library, self.p_general))


def detect(recordings: Recordings, fitted: Fitted, found: Signatures, law: Array, random: np.random.Generator) -> Detection:
    """By recordings simulated with the fitted model: noise of the recording's colour on the output, and of the
    displacement's size on the input, taken through the same smoothing, model and band. Each score is told in standard
    deviations of its own under that noise, which reaches some signatures more than others."""
    misfit = fitted_residual(fitted)
    drawn = _null_misfits(recordings, fitted, random)
    lengths = np.sum((drawn @ law) ** 2, axis=1)
    explained = float(np.sum((misfit @ law) ** 2))
    p_general = _upper_tail(explained, lengths) if law.shape[1] else 1.0
    if not len(found.rows):
        return Detection(np.zeros(0), 0.0, 1.0, p_general, explained, float(lengths.mean()))
    null = found.scores(drawn)
    centre, spread = null.mean(axis=0), np.maximum(null.std(axis=0), 1e-3)
    scores = (found.scores(misfit) - centre) / spread
    largest = float(scores.max())
    p_library = p_value(largest, ((null - centre) / spread).max(axis=1))
    return Detection(scores, largest, p_library, p_general, explained, float(lengths.mean()))


def fitted_residual(fitted: Fitted) -> Array:
    absorbed = absorber(fitted.jacobian)
    left: Array = fitted.misfit - absorbed @ (absorbed.T @ fitted.misfit)
    return left


def p_value(largest: float, null: Array) -> float:
    """Of the replicates where they reach that far, else of the extreme-value law through them."""
    beyond = int(np.sum(null >= largest))
    if beyond >= 5:
        return (1 + beyond) / (1 + len(null))
    location, scale = gumbel_r.fit(null)
    return max(float(gumbel_r.sf(largest, location, scale)), TINIEST)


def _upper_tail(length: float, null: Array) -> float:
    """Of the gamma law with the mean and variance of the replicates, which squared lengths follow nearly."""
    mean, variance = float(null.mean()), float(null.var())
    return max(float(gamma.sf(length, mean * mean / variance, scale=variance / mean)), TINIEST)


def _null_misfits(recordings: Recordings, fitted: Fitted, random: np.random.Generator) -> Array:
    absorbed = absorber(fitted.jacobian)
    component = recordings.component
    before = recordings.predicted(fitted.parts)
    seeds = random.integers(2**63, size=REPLICATES)
    beyond = len(fitted.misfit) - fitted.samples

    def drawn(seed: int) -> Array:
        own = np.random.default_rng(seed)
        found = []
        for one, plain, weights in zip(recordings.data, before, recordings.weights, strict=True):
            noise = np.array([model.drawn(plain.shape[1], own) for model in recordings.noises]) / weights
            if one.input_noise > 0:
                noise = noise + plain - component.predicted(fitted.parts, one.redrawn(own))
            found.append(noise)
        misfit = np.concatenate([recordings.joined(found), own.standard_normal(beyond)])
        left: Array = misfit - absorbed @ (absorbed.T @ misfit)
        return left

    return np.array(each(drawn, [int(seed) for seed in seeds]))
