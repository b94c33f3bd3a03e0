"""The rival "none of these": a flexible law with memory, fitted to the residual of the planned model.

It knows no physics: smooth random functions of displacement, velocity, their slow parts and the dissipated energy. Where it
predicts held-out data better than the named effects, something else than these effects is present.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from scipy.signal import lfilter

from rths_engine.diagnosis.components import Structure
from rths_engine.diagnosis.fitting import Recordings
from rths_engine.diagnosis.held_out import HeldOut
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import Part
from rths_engine.running.stop import stop

# chosen; see docs/decisions/0023
NEURONS = 60
SLOW = (0.1, 0.5, 3.0)  # s
STOPS = (0.1, 0.3, 0.7)  # of the largest displacement
RIDGES = (1e-4, 1e-3, 1e-2, 0.1, 1.0, 10.0, 100.0, 1e3, 1e4)
FOLDS = 5
MOST_MODES = 3


def flexible(recordings: Recordings, heldout: HeldOut, base: Sequence[Part]) -> list[Array]:
    """Residuals (channels, n) of the held-out data after the flexible law is fitted to the residual of the `base` parts.

    The law is a ridge regression of the whitened residual on the responses to random functions of the state, an extreme
    learning machine (Huang, Zhu and Siew 2006, Neurocomputing 70, 489-501). Contiguous folds of the fitted data choose the
    ridge.
    """
    sizes = _sizes(recordings)
    trained = [_responses(recordings, one, sizes) for one in recordings.data]
    asked = [_responses(recordings, one, sizes) for one in heldout.data]
    left = recordings.residuals(base)
    before = heldout.residuals(base)
    found = [one.copy() for one in before]
    for channel, noise in enumerate(recordings.noises):
        rows, goals = [], []
        for terms, residual, mask, weights in zip(trained, left, recordings.masks, recordings.weights, strict=True):
            white = noise.whitened(np.vstack([residual[channel], terms]) * weights[channel])[:, mask]
            rows.append(white[1:])
            goals.append(white[0])
        coefficients = _ridge(np.concatenate(rows, axis=1).T, np.concatenate(goals))
        for one, terms in zip(found, asked, strict=True):
            one[channel] -= coefficients @ terms
    return [heldout.about_zero(one, mask) for one, mask in zip(found, heldout.masks, strict=True)]


def _sizes(recordings: Recordings) -> tuple[float, float]:
    """Largest displacement and velocity of the fitted data."""
    motions = [recordings.component.signals(one) for one in recordings.data]
    x, v = (max(float(np.max(np.abs(pair[place].values))) for pair in motions) for place in (0, 1))
    return max(x, 1e-300), max(v, 1e-300)


def _responses(recordings: Recordings, data: Any, sizes: tuple[float, float]) -> Array:
    """Responses (terms, n) to the functions of the state; for a structure, passed through its lowest modes."""
    x, v = (signal.values / size for signal, size in zip(recordings.component.signals(data), sizes, strict=True))
    side = np.tanh(v / 0.05)
    slow = []
    for time in SLOW:
        keep = float(np.exp(-data.step / time))
        slow += [lfilter([1 - keep], [1, -keep], one) for one in (x, side)]
    hysteresis = [stop(x, width) for width in STOPS]
    energy = np.cumsum(np.abs(v) * np.abs(x)) * data.step / 10.0
    state = np.array([x, v, side, *slow, *hysteresis, np.tanh(energy)])
    random = np.random.default_rng(0)
    mix = random.normal(0.0, 1.0, (NEURONS, len(state))) * (random.random((NEURONS, len(state))) < 0.35)
    neurons = np.tanh(mix @ state + random.normal(0.0, 0.5, NEURONS)[:, None])
    terms = np.vstack([state, x**3, v * np.abs(v), x * x * v, neurons])
    component = recordings.component
    if not isinstance(component, Structure):
        return terms
    periods = [float(period) for period in component.model.periods[:MOST_MODES]]
    return np.vstack([_oscillated(terms, period, data.step) for period in periods])


def _oscillated(terms: Array, period: float, step: float) -> Array:
    """Responses of an oscillator with 2 % damping to the terms as forces."""
    omega = 2 * np.pi / period
    decay = float(np.exp(-0.02 * omega * step))
    found: Array = lfilter([(omega * step) ** 2], [1, -2 * decay * np.cos(omega * step), decay * decay], terms, axis=1)
    return found


def _ridge(rows: Array, goal: Array) -> Array:
    """Coefficients of a ridge regression whose ridge predicts contiguous folds best."""
    scale = np.maximum(np.sqrt(np.mean(rows**2, axis=0)), 1e-300)
    rows = rows / scale
    folds = np.arange(len(goal)) * FOLDS // len(goal)
    grams = [rows[folds == fold].T @ rows[folds == fold] for fold in range(FOLDS)]
    rights = [rows[folds == fold].T @ goal[folds == fold] for fold in range(FOLDS)]
    whole, right = sum(grams), sum(rights)
    unit = len(goal) * np.eye(rows.shape[1])

    def missed(ridge: float) -> float:
        total = 0.0
        for fold in range(FOLDS):
            found = np.linalg.solve(whole - grams[fold] + ridge * unit, right - rights[fold])
            total += float(np.sum((goal[folds == fold] - rows[folds == fold] @ found) ** 2))
        return total

    best = min(RIDGES, key=missed)
    found: Array = np.linalg.solve(whole + best * unit, right) / scale
    return found
