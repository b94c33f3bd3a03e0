"""Detection of a mismatch: whether the residual holds more than noise.

The test is a parametric bootstrap of the largest score over the library, and of what any law of motion, energy and time could
account for.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from scipy.stats import chi2, gamma, gumbel_r

from rths_engine.diagnosis.fitting import Fitted, Recordings
from rths_engine.diagnosis.parallel import each
from rths_engine.diagnosis.signatures import Signatures, absorber
from rths_engine.foundation.arrays import Array

# chosen; see docs/decisions/0023
REPLICATES = 99
REDRAWN = 16  # times that the error of the input is drawn
COUNTED = 5  # replicates beyond the score, from which its chance is their share
TINIEST = 1e-300
LEAST_OWN = 0.01  # of the power of all noise


@dataclass(frozen=True)
class Detection:
    """Scores of the signatures, the largest score, and its p-value where nothing was left out.

    The same for the squared length of the general law, with its expected length where nothing was left out, and for how far
    the planned numbers left their plan.
    """

    scores: Array
    largest: float
    p_library: float
    p_general: float
    p_planned: float
    explained: float  # squared length that a general law accounts for
    expected: float

    @property
    def p_value(self) -> float:
        """Of all tests."""
        return min(1.0, 3 * min(self.p_library, self.p_general, self.p_planned))


def detect(recordings: Recordings, fitted: Fitted, found: Signatures, law: Array, random: np.random.Generator) -> Detection:
    """Compare the scores with those of recordings that the fitted model simulates.

    Noise of the recording's colour is added to the output, and of the displacement's size to the input, and taken through the
    same smoothing, model and band. The power along a signature or a law is compared with the power that is not, at the same
    frequencies, so that noise of another level than assumed raises no alarm. Each score is in standard deviations of its own,
    since noise reaches some signatures more than others.
    """
    absorbed = absorber(fitted.jacobian)
    drawn = null_misfits(recordings, fitted, random)
    drawn -= drawn @ absorbed @ absorbed.T
    misfits = np.vstack([fitted_residual(fitted), drawn])
    along, beside = misfits @ law, _beside_span(misfits, law)
    lengths = np.sum(along**2, axis=1) / _relative(beside)
    explained, expected = float(lengths[0]), float(lengths[1:].mean())
    p_general = _upper_tail(explained, lengths[1:]) if law.shape[1] else 1.0
    if not len(found.rows):
        return Detection(np.zeros(0), 0.0, 1.0, p_general, p_planned(fitted), explained, expected)
    scores = found.scores(misfits) / np.sqrt(_relative(_beside_each(misfits, found.rows)))
    centre, spread = scores[1:].mean(axis=0), np.maximum(scores[1:].std(axis=0), 1e-3)
    scores = (scores - centre) / spread
    largest = float(scores[0].max())
    p_library = p_value(largest, scores[1:].max(axis=1))
    return Detection(scores[0], largest, p_library, p_general, p_planned(fitted), explained, expected)


def _beside_span(misfits: Array, columns: Array) -> Array:
    """(B) the power of misfits (B, N) at the frequencies of orthonormal columns (N, r), without their part along these."""
    rest = misfits - misfits @ columns @ columns.T
    weight = np.sum(np.abs(np.fft.rfft(columns, axis=0)) ** 2, axis=1)
    found: Array = np.abs(np.fft.rfft(rest, axis=1)) ** 2 @ weight
    return found


def _beside_each(misfits: Array, rows: Array) -> Array:
    """(B, K) likewise, of each unit row (K, N) alone."""
    along = misfits @ rows.T
    of_misfits, of_rows = np.fft.rfft(misfits, axis=1), np.fft.rfft(rows, axis=1)
    weight = np.abs(of_rows) ** 2
    crossed = (of_misfits.conj() @ (weight * of_rows).T).real
    found: Array = np.abs(of_misfits) ** 2 @ weight.T - 2 * along * crossed + along**2 * np.sum(weight**2, axis=1)
    return found


def _relative(powers: Array) -> Array:
    """Powers, the first of the recording and the others of replicates, over the replicates' mean."""
    found: Array = powers / np.maximum(powers[1:].mean(axis=0), TINIEST)
    return np.maximum(found, TINIEST)


def p_planned(fitted: Fitted) -> float:
    """That the planned numbers are as far off their plan by their spread alone."""
    off = fitted.misfit[fitted.samples :]
    return float(chi2.sf(float(off @ off), len(off))) if len(off) else 1.0


def fitted_residual(fitted: Fitted) -> Array:
    """The misfit less what the fitted numbers can absorb."""
    absorbed = absorber(fitted.jacobian)
    left: Array = fitted.misfit - absorbed @ (absorbed.T @ fitted.misfit)
    return left


def p_value(largest: float, null: Array) -> float:
    """Of the replicates where they reach that far, else of the extreme-value law through them."""
    beyond = int(np.sum(null >= largest))
    if beyond >= COUNTED:
        return (1 + beyond) / (1 + len(null))
    location, scale = gumbel_r.fit(null)
    return float(gumbel_r.sf(largest, location, scale))


def _upper_tail(length: float, null: Array) -> float:
    """Of the gamma law with the mean and variance of the replicates, which squared lengths follow nearly."""
    mean, variance = float(null.mean()), float(null.var())
    return float(gamma.sf(length, mean * mean / variance, scale=variance / mean))


def null_misfits(recordings: Recordings, fitted: Fitted, random: np.random.Generator) -> Array:
    """Misfits (B, N) of the fitted model where nothing was left out."""
    inputs = _inputs(recordings, fitted, random)
    own = _own(recordings, inputs)
    seeds = random.integers(2**63, size=REPLICATES)
    beyond = len(fitted.misfit) - fitted.samples

    def drawn(place: int) -> Array:
        random = np.random.default_rng(seeds[place])
        found = []
        for reached, weights in zip(inputs[place % len(inputs)], recordings.weights, strict=True):
            noise = np.array([model.drawn(weights.shape[1], random) for model in recordings.noises])
            found.append(own[:, None] * noise / weights + reached)
        return np.concatenate([recordings.joined(found), random.standard_normal(beyond)])

    return np.array(each(drawn, range(REPLICATES)))


def _inputs(recordings: Recordings, fitted: Fitted, random: np.random.Generator) -> list[list[Array]]:
    """Changes of the residuals that the error of the input may cause, drawn several times.

    The error of a smoothed input is independent of it (Berkson 1950, JASA 45, 164-180), and so biases nothing.
    """
    before = recordings.predicted(fitted.parts)
    if not any(one.input_noise > 0 for one in recordings.data):
        return [[np.zeros_like(plain) for plain in before]]
    draws = [tuple(one.redrawn(random) for one in recordings.data) for _ in range(REDRAWN)]

    def reached(drawn: tuple[Any, ...]) -> list[Array]:
        found = replace(recordings, data=drawn).predicted(fitted.parts)
        return [one - plain for plain, one in zip(before, found, strict=True)]

    return each(reached, draws)


def _own(recordings: Recordings, inputs: Sequence[Sequence[Array]]) -> Array:
    """(channels) the deviation of the output's own noise, in units of all noise: the input's is in the residuals too."""
    misfits = [recordings.channels(recordings.joined(one)) for one in inputs]
    powers = [[float(np.mean(np.concatenate(rows) ** 2)) for rows in channels] for channels in misfits]
    share: Array = np.mean(powers, axis=0)
    return np.sqrt(np.clip(1 - share, LEAST_OWN, 1.0))
