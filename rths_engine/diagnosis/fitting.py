"""Joint fit of planned parts and effects to recordings by least squares."""

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
RUNAWAY = 1e3  # times the largest measured value: a larger simulated value is cut
ROUGH = 12  # evaluations of a rough fit, which sorts out hopeless models
CLOSE = 1e-6  # relative change of the squared misfit at which a search ends, far below the 1 that evidence weighs


@dataclass(frozen=True)
class Recordings:
    """The recordings that a component is fitted to: data, fitted samples, and the noise of each output channel.

    `weights` are the weights of the samples. A weight is smaller where noise on the input reaches the output, or where the
    remaining residual is larger than elsewhere.
    """

    component: Component
    data: tuple[Any, ...]
    masks: tuple[NDArray[np.bool_], ...]  # True where fitted
    noises: tuple[Noise, ...]
    weights: tuple[Array, ...]  # (channels, n) each
    steady: tuple[Array, ...]  # (channels, n) each: the weights from the noise of the input alone

    def predicted(self, parts: Sequence[Part]) -> list[Array]:
        """The simulated output of each recording, cut at RUNAWAY where a model diverges."""
        found = []
        for one in self.data:
            largest = RUNAWAY * np.max(np.abs(one.measured), axis=1, keepdims=True)
            found.append(np.clip(np.nan_to_num(self.component.predicted(parts, one)), -largest, largest))
        return found

    def residuals(self, parts: Sequence[Part]) -> list[Array]:
        return [one.measured - found for one, found in zip(self.data, self.predicted(parts), strict=True)]

    def misfit(self, parts: Sequence[Part]) -> Array:
        """The misfit: whitened residuals of the fitted samples in one vector."""
        return self.joined(self.residuals(parts))

    def joined(self, signals: Sequence[Array]) -> Array:
        """Whitened `signals` (channels, n) of the fitted samples in one vector, by recording, then by channel."""
        rows = []
        for signal, mask, weights in zip(signals, self.masks, self.weights, strict=True):
            rows += [noise.whitened(channel)[mask] for channel, noise in zip(weights * signal, self.noises, strict=True)]
        return np.concatenate(rows)

    def channels(self, misfit: Array) -> list[list[Array]]:
        """The parts of a misfit that belong to each channel."""
        counts = [int(mask.sum()) for mask in self.masks for _ in self.noises]
        rows = np.split(misfit, np.cumsum(counts)[:-1])
        return [rows[place :: len(self.noises)] for place in range(len(self.noises))]

    @property
    def samples(self) -> int:
        return len(self.noises) * sum(int(mask.sum()) for mask in self.masks)


@dataclass(frozen=True)
class Fitted:
    """A fitted model: its parts, its free parameters `z`, its misfit and the Jacobian.

    The first `samples` rows of the misfit are in units of the noise. The rows that follow are the changes of the planned
    parameters in units of their spread. The Jacobian covers both.
    """

    parts: tuple[Part, ...]
    free: tuple[Number, ...]
    z: Array
    misfit: Array
    jacobian: Array
    samples: int

    @property
    def squared(self) -> float:
        """chi^2 of the recordings alone, without the changes of the planned parameters."""
        return float(self.misfit[: self.samples] @ self.misfit[: self.samples])

    @property
    def bic(self) -> float:
        """BIC = chi^2 + k ln N, where chi^2 includes the changes of the planned parameters."""
        return float(self.misfit @ self.misfit) + len(self.free) * float(np.log(self.samples))


def fit(recordings: Recordings, parts: Sequence[Part], evaluations: int = EVALUATIONS) -> Fitted:
    """Fit all free parameters of the parts by least squares of the whitened misfit, from their present values.

    Between Jacobians by differences, secants update the Jacobian (Broyden 1965). A second search begins at the end of the first
    search with a Jacobian by differences. `evaluations` limits the first search.
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
    """The parts with their present values as a fitted model, with misfit and Jacobian."""
    free, misfit, start, bounds = problem(recordings, parts)
    plain = misfit(start)
    return Fitted(tuple(parts), tuple(free), start, plain, differences(misfit, start, plain, bounds), recordings.samples)


def compared(recordings: Recordings, fitted: Fitted) -> Fitted:
    """A model that was fitted before, with its misfit for the noise of these recordings."""
    _, misfit, start, _ = problem(recordings, fitted.parts)
    return replace(fitted, misfit=misfit(start))


def problem(
    recordings: Recordings, parts: Sequence[Part], free: Sequence[Number] | None = None
) -> tuple[list[Number], Callable[[Array], Array], Array, Array]:
    """The fit as a least-squares problem: free parameters, misfit as a function of z, z of the parts, and bounds of z.

    `free` are the parameters of an earlier fit, whose scales of z are kept. Without them, the values of `parts` are the scales.
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
