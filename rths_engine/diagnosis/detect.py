"""Detection of a mismatch: p-values of the residual, by a parametric bootstrap.

Three quantities are tested: the largest score of an effect of the library, the power that a general law of motion, energy and
time explains, and the change of the planned parameters.
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
REDRAWN = 16  # draws of the error of the input
COUNTED = 5  # fewest replicates beyond the score for a p-value by counting
TINIEST = 1e-300
LEAST_OWN = 0.01  # smallest share of the output's own noise in the power of all noise


@dataclass(frozen=True)
class Detection:
    """Scores of the signatures and three p-values, each the probability of a value at least this large if nothing was left out.

    `p_library` is the p-value of the largest score, `p_general` that of the squared length that the general law explains, and
    `p_planned` that of the change of the planned parameters. `expected` is the mean of `explained` if nothing was left out.
    """

    scores: Array
    largest: float
    p_library: float
    p_general: float
    p_planned: float
    explained: float  # squared length of the residual that the general law explains
    expected: float

    @property
    def p_value(self) -> float:
        """The p-value of all three tests, by Bonferroni's bound."""
        return min(1.0, 3 * min(self.p_library, self.p_general, self.p_planned))


def detect(fitted: Fitted, found: Signatures, law: Array, drawn: Array) -> Detection:
    """Compare the scores of the recording with the scores of recordings that the fitted model simulates.

    `found` are the signatures, `law` (N, r) the columns of the general law, and `drawn` (B, N) the `null_misfits`. Noise with
    the colour of the recording's noise is added to the output, and noise of the displacement's size to the input. Both pass
    through the same smoothing, model and band. The power along a signature or a law is divided by the power beside it at the
    same frequencies, so that a wrong noise level raises no false alarm. Each score is in its own standard deviations, because
    noise reaches some signatures more than others.
    """
    absorbed = absorber(fitted.jacobian)
    misfits = np.vstack([fitted.misfit, drawn])
    misfits -= misfits @ absorbed @ absorbed.T
    p_general, explained, expected = _by_law(misfits, law)
    if not len(found.rows):
        return Detection(np.zeros(0), 0.0, 1.0, p_general, p_planned(fitted), explained, expected)
    scores = found.scores(misfits) / np.sqrt(_relative(_beside_each(misfits, found.rows)))
    centre, spread = scores[1:].mean(axis=0), np.maximum(scores[1:].std(axis=0), 1e-3)
    scores = (scores - centre) / spread
    largest = float(scores[0].max())
    p_library = p_value(largest, scores[1:].max(axis=1))
    return Detection(scores[0], largest, p_library, p_general, p_planned(fitted), explained, expected)


def left(before: Detection, fitted: Fitted, law: Array, drawn: Array) -> Detection:
    """The detection of another model with as many effects: only what the general law explains is computed again."""
    absorbed = absorber(fitted.jacobian)
    misfits = np.vstack([fitted.misfit, drawn])
    misfits -= misfits @ absorbed @ absorbed.T
    p_general, explained, expected = _by_law(misfits, law)
    return replace(before, p_general=p_general, p_planned=p_planned(fitted), explained=explained, expected=expected)


def _by_law(misfits: Array, law: Array) -> tuple[float, float, float]:
    """The p-value of the squared length of the first misfit along the law, that length, and its mean over the replicates."""
    along, beside = misfits @ law, _beside_span(misfits, law)
    lengths = np.sum(along**2, axis=1) / _relative(beside)
    chance = _upper_tail(float(lengths[0]), lengths[1:]) if law.shape[1] else 1.0
    return chance, float(lengths[0]), float(lengths[1:].mean())


def _beside_span(misfits: Array, columns: Array) -> Array:
    """Power (B) of misfits (B, N) beside orthonormal columns (N, r), at the frequencies of these columns."""
    rest = misfits - misfits @ columns @ columns.T
    weight = np.sum(np.abs(np.fft.rfft(columns, axis=0)) ** 2, axis=1)
    found: Array = np.abs(np.fft.rfft(rest, axis=1)) ** 2 @ weight
    return found


def _beside_each(misfits: Array, rows: Array) -> Array:
    """Power (B, K) of misfits (B, N) beside each unit row (K, N), at the frequencies of that row."""
    along = misfits @ rows.T
    of_misfits, of_rows = np.fft.rfft(misfits, axis=1), np.fft.rfft(rows, axis=1)
    weight = np.abs(of_rows) ** 2
    crossed = (of_misfits.conj() @ (weight * of_rows).T).real
    found: Array = np.abs(of_misfits) ** 2 @ weight.T - 2 * along * crossed + along**2 * np.sum(weight**2, axis=1)
    return found


def _relative(powers: Array) -> Array:
    """Powers over the mean power of the replicates; the first power is the recording's, the others are the replicates'."""
    found: Array = powers / np.maximum(powers[1:].mean(axis=0), TINIEST)
    return np.maximum(found, TINIEST)


def p_planned(fitted: Fitted) -> float:
    """The p-value of the change of the planned parameters: probability of a change at least this large within their spread."""
    off = fitted.misfit[fitted.samples :]
    return float(chi2.sf(float(off @ off), len(off))) if len(off) else 1.0


def p_value(largest: float, null: Array) -> float:
    """The p-value of the largest score: by counting replicates, or by an extreme-value law fitted to them if few reach it."""
    beyond = int(np.sum(null >= largest))
    if beyond >= COUNTED:
        return (1 + beyond) / (1 + len(null))
    location, scale = gumbel_r.fit(null)
    return float(gumbel_r.sf(largest, location, scale))


def _upper_tail(length: float, null: Array) -> float:
    """The p-value of a squared length, by the gamma law with the mean and the variance of the replicates."""
    mean, variance = float(null.mean()), float(null.var())
    return float(gamma.sf(length, mean * mean / variance, scale=variance / mean))


def null_misfits(recordings: Recordings, fitted: Fitted, random: np.random.Generator) -> Array:
    """Misfits (B, N) of replicates: recordings of the fitted model in which nothing was left out."""
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
    """Changes of the residuals by the error of the input, for several draws of this error.

    The error of a smoothed input is independent of the input (Berkson 1950, JASA 45, 164-180), so it causes no bias.
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
    """Standard deviation (channels) of the output's own noise in units of all noise, which includes noise from the input."""
    misfits = [recordings.channels(recordings.joined(one)) for one in inputs]
    powers = [[float(np.mean(np.concatenate(rows) ** 2)) for rows in channels] for channels in misfits]
    share: Array = np.mean(powers, axis=0)
    return np.sqrt(np.clip(1 - share, LEAST_OWN, 1.0))
