"""Planned parts and effects fitted jointly to recordings."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares

from rths_engine.diagnosis.components import Component
from rths_engine.diagnosis.free import Number, moved, numbers, vector
from rths_engine.diagnosis.noise import Noise
from rths_engine.diagnosis.slopes import Slopes, differences
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import Part

# chosen; see docs/decisions/0023
EVALUATIONS = 40
RUNAWAY = 1e3  # times the largest measured value
ROUGH = 12  # evaluations that tell the hopeless
CLOSE = 1e-6  # of the squared misfit: far below the 1 that evidence weighs


@dataclass(frozen=True)
class Recordings:
    """What a component is fitted to: its data, the samples that count, and the noise of each channel of the output.

    `weights` says how much each sample counts: less where noise on the input reaches the output more, or where more is left
    than noise elsewhere.
    """

    component: Component
    data: tuple[Any, ...]
    masks: tuple[NDArray[np.bool_], ...]  # True where fitted
    noises: tuple[Noise, ...]
    weights: tuple[Array, ...]  # (channels, n) each
    steady: tuple[Array, ...]  # likewise, by the input's noise alone

    def predicted(self, parts: Sequence[Part]) -> list[Array]:
        """Each recording's output, cut where a model runs away."""
        found = []
        for one in self.data:
            largest = RUNAWAY * np.max(np.abs(one.measured), axis=1, keepdims=True)
            found.append(np.clip(np.nan_to_num(self.component.predicted(parts, one)), -largest, largest))
        return found

    def residuals(self, parts: Sequence[Part]) -> list[Array]:
        return [one.measured - found for one, found in zip(self.data, self.predicted(parts), strict=True)]

    def misfit(self, parts: Sequence[Part]) -> Array:
        """Whitened residuals of the fitted samples in a row."""
        return self.joined(self.residuals(parts))

    def joined(self, signals: Sequence[Array]) -> Array:
        """Whitened signals (channels, n) of the fitted samples in a row: recording by recording, channel by channel."""
        rows = []
        for signal, mask, weights in zip(signals, self.masks, self.weights, strict=True):
            rows += [noise.whitened(channel)[mask] for channel, noise in zip(weights * signal, self.noises, strict=True)]
        return np.concatenate(rows)

    def channels(self, misfit: Array) -> list[list[Array]]:
        """The rows of each channel of a misfit."""
        counts = [int(mask.sum()) for mask in self.masks for _ in self.noises]
        rows = np.split(misfit, np.cumsum(counts)[:-1])
        return [rows[place :: len(self.noises)] for place in range(len(self.noises))]

    @property
    def samples(self) -> int:
        return len(self.noises) * sum(int(mask.sum()) for mask in self.masks)


@dataclass(frozen=True)
class Fitted:
    """A fitted model: its parts, its misfit and the Jacobian.

    The misfit is in units of the noise. Behind it stands how far the planned numbers went, in units of their spread; the
    Jacobian covers both.
    """

    parts: tuple[Part, ...]
    free: tuple[Number, ...]
    z: Array
    misfit: Array
    jacobian: Array
    samples: int

    @property
    def squared(self) -> float:
        """Of the recordings alone."""
        return float(self.misfit[: self.samples] @ self.misfit[: self.samples])

    @property
    def bic(self) -> float:
        """chi^2 + k ln N, with the numbers' chances beforehand in chi^2."""
        return float(self.misfit @ self.misfit) + len(self.free) * float(np.log(self.samples))


def fit(recordings: Recordings, parts: Sequence[Part], evaluations: int = EVALUATIONS) -> Fitted:
    """The least squares of the whitened misfit over every free number of the parts, from where they are.

    Between Jacobians by differences the Jacobian is kept by secants (Broyden 1965); the search then begins once more, with a
    Jacobian by differences, where the first ended.
    """
    free, misfit, start, bounds = problem(recordings, parts)
    if not free:
        return evaluated(recordings, parts)
    for rest in (evaluations, evaluations // 4):
        slopes = Slopes(misfit, bounds)
        solved = least_squares(
            slopes.misfit, start, slopes.jacobian, bounds=bounds.T, x_scale="jac", max_nfev=rest, ftol=CLOSE, xtol=CLOSE
        )
        start = solved.x
        if evaluations <= ROUGH:
            break
    return Fitted(tuple(moved(parts, free, solved.x)), tuple(free), solved.x, solved.fun, solved.jac, recordings.samples)


def evaluated(recordings: Recordings, parts: Sequence[Part]) -> Fitted:
    """The parts as they are, with the misfit's Jacobian."""
    free, misfit, start, bounds = problem(recordings, parts)
    plain = misfit(start)
    return Fitted(tuple(parts), tuple(free), start, plain, differences(misfit, start, plain, bounds), recordings.samples)


def compared(recordings: Recordings, fitted: Fitted) -> Fitted:
    """A model fitted before, with its misfit under the noise of these recordings."""
    _, misfit, start, _ = problem(recordings, fitted.parts)
    return replace(fitted, misfit=misfit(start))


def problem(
    recordings: Recordings, parts: Sequence[Part], free: Sequence[Number] | None = None
) -> tuple[list[Number], Callable[[Array], Array], Array, Array]:
    """The free numbers of the parts, the misfit as a function of z, z of the parts, and its bounds.

    Give the numbers `free` of an earlier fit to keep the scales of its z; without them the values of `parts` are the scales.
    """
    free = numbers(recordings.component, parts) if free is None else list(free)
    bounds = np.array([number.bounds for number in free]).reshape(-1, 2)
    start = np.clip(vector(parts, free), bounds[:, 0] + 1e-9, bounds[:, 1] - 1e-9)
    known = [place for place, number in enumerate(free) if np.isfinite(number.spread)]
    planned = np.array([free[place].planned for place in known])
    spread = np.array([free[place].spread for place in known])

    def misfit(z: Array) -> Array:
        return np.concatenate([recordings.misfit(moved(parts, free, z)), (z[known] - planned) / spread])

    return free, misfit, start, bounds
