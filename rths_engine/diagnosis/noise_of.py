"""Estimate of the noise from the residual, after the models and a few terms of a general law are removed."""

from __future__ import annotations

import itertools
from dataclasses import replace
from functools import partial

import numpy as np
from scipy.ndimage import uniform_filter1d

from rths_engine.diagnosis.fitting import Fitted, Recordings, evaluated
from rths_engine.diagnosis.noise import Noise, coloured
from rths_engine.diagnosis.parallel import each
from rths_engine.diagnosis.signatures import general_terms, signatures
from rths_engine.foundation.arrays import Array

# chosen; see docs/decisions/0023
FIRST_GUESS = 0.01  # noise over the standard deviation of the output, at the start of the estimate
LEAST_NOISE = 1e-6  # smallest noise over the standard deviation of the output: numbers in files are rounded
DRAWS = 12
SMOOTHED = 0.1  # s
EVENED, UNEVEN = 1.0, 1.5  # s; multiple of the median power above which the weight of samples falls
ROUNDS = 4
MOST_TERMS = 12
CLEAR = 4.0  # standard deviations of the noise: a larger term is not noise


def first_noise(recordings: Recordings) -> Recordings:
    """The recordings with white noise of FIRST_GUESS times each channel's standard deviation, to start a fit."""
    spread = np.std(np.concatenate([one.measured for one in recordings.data], axis=1), axis=1)
    return replace(recordings, noises=tuple(Noise.white(max(FIRST_GUESS * float(one), 1e-300)) for one in spread))


def weighted(recordings: Recordings, fitted: Fitted, random: np.random.Generator) -> Recordings:
    """The recordings with the weights 1 / sqrt(1 + s^2 / sigma^2) of the samples.

    s is the standard deviation of the output by noise on the input, together with the change of the output where half of the
    input samples are left out (at jumps). sigma is a robust standard deviation of the residual.
    """
    residuals = recordings.residuals(fitted.parts)
    weights = []
    for one, residual in zip(recordings.data, residuals, strict=True):
        if one.input_noise == 0:
            weights.append(np.ones(residual.shape))
            continue
        draws = [one.redrawn(random) for _ in range(DRAWS)]
        asked = [one, one.thinned(), one.behind(), *draws]
        plain, thin, behind, *drawn = each(partial(recordings.component.predicted, fitted.parts), asked)
        reached = np.sqrt(np.var(drawn, axis=0) + (thin - plain) ** 2 + (behind - plain) ** 2)
        # 1 / 0.6745: the median of |r| of a normal law over its deviation
        sigma = np.maximum(1.4826 * np.median(np.abs(residual), axis=1, keepdims=True), 1e-300)
        width = max(1, round(SMOOTHED / one.step))
        local = np.sqrt(np.maximum(uniform_filter1d(reached**2, width, axis=1), 0.0))
        weights.append(1 / np.sqrt(1 + (local / sigma) ** 2))
    return replace(recordings, weights=tuple(weights), steady=tuple(weights))


def with_noise(recordings: Recordings, fitted: Fitted) -> Recordings:
    """Estimate the noise of a fit.

    The first estimate is the whole residual of the fit. Then significant terms of the library's effects and of a general law
    are removed one after another, and the noise is estimated again. Samples have smaller weights where the remaining residual
    is clearly larger than elsewhere for EVENED seconds.
    """
    plain = first_noise(replace(recordings, weights=recordings.steady))
    now = evaluated(plain, fitted.parts)
    count = now.samples
    terms = np.column_stack([signatures(plain, now, sized=False).rows.T[:count], general_terms(plain, now)[:count]])
    residual = now.misfit[:count]
    noises = _noises(plain, residual, residual)
    taken: list[int] = []
    for _ in range(ROUNDS):
        white = _whitened(plain, noises, np.column_stack([now.misfit[:count], now.jacobian[:count], terms]))
        misfit, known, offered = white[:, 0], white[:, 1 : 1 + len(now.free)], white[:, 1 + len(now.free) :]
        before = len(taken)
        taken = _clear(misfit, known, offered, taken)
        columns = np.column_stack([now.jacobian[:count], terms[:, taken]])
        weights = np.linalg.lstsq(np.column_stack([known, offered[:, taken]]), misfit, rcond=None)[0]
        left = residual - columns @ weights
        noises = _noises(plain, left, residual)
        if len(taken) == before:
            break
    shares = _evened(plain, _whitened(plain, noises, left[:, None])[:, 0])
    even = np.concatenate([share[mask] for one, mask in zip(shares, plain.masks, strict=True) for share in one])
    noises = _noises(plain, even * left, even * residual)
    found: list[Array] = [share * steady for share, steady in zip(shares, plain.steady, strict=True)]
    return replace(recordings, noises=noises, weights=tuple(found))


def _evened(plain: Recordings, white: Array) -> list[Array]:
    """Weights (channels, n) for each recording: 1, or less where the power of the whitened noise exceeds its median."""
    parts = np.split(white, np.cumsum([int(mask.sum()) for mask in plain.masks for _ in plain.noises])[:-1])
    found: list[Array] = []
    count = len(plain.noises)
    for place, (one, mask) in enumerate(zip(plain.data, plain.masks, strict=True)):
        rows = []
        for row in parts[place * count : (place + 1) * count]:
            local = uniform_filter1d(row**2, max(1, round(EVENED / one.step)))
            share = np.ones(len(mask))
            share[mask] = np.sqrt(np.minimum(1.0, UNEVEN * np.median(local) / np.maximum(local, 1e-300)))
            rows.append(share)
        found.append(np.array(rows))
    return found


def _clear(misfit: Array, known: Array, offered: Array, taken: list[int]) -> list[int]:
    """Indices of the terms that are significant beside the noise, selected one after another."""
    taken = list(taken)
    while len(taken) < MOST_TERMS:
        basis = np.linalg.qr(np.column_stack([known, offered[:, taken]]))[0]
        left = offered - basis @ (basis.T @ offered)
        sizes = np.linalg.norm(left, axis=0)
        usable = sizes > 1e-3 * np.maximum(np.linalg.norm(offered, axis=0), 1e-300)
        rest = misfit - basis @ (basis.T @ misfit)
        scores = np.where(usable, np.abs(rest @ left) / np.maximum(sizes, 1e-300), 0.0)
        best = int(np.argmax(scores)) if len(scores) else -1
        if best < 0 or scores[best] < CLEAR:
            break
        taken.append(best)
    return taken


def _noises(plain: Recordings, noise: Array, residual: Array) -> tuple[Noise, ...]:
    found = []
    for rows, whole, white in zip(plain.channels(noise), plain.channels(residual), plain.noises, strict=True):
        power, most = (sum(float(one @ one) for one in some) for some in (rows, whole))
        beyond = most / max(power, 1e-300) - 1
        found.append(coloured(rows, beyond).times(white.scale, LEAST_NOISE / FIRST_GUESS))
    return tuple(found)


def _whitened(plain: Recordings, noises: tuple[Noise, ...], columns: Array) -> Array:
    """Columns of misfits that were whitened with the noise of `plain`, whitened with `noises` instead."""
    rows = []
    ends = np.cumsum([0] + [int(mask.sum()) for mask in plain.masks for _ in plain.noises])
    for place, (start, end) in enumerate(itertools.pairwise(ends)):
        channel = place % len(noises)
        rows.append(noises[channel].whitened(plain.noises[channel].scale * columns[start:end].T).T)
    return np.concatenate(rows)
