"""Baseline and effects fitted jointly to recordings."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares

from rths_engine.arrays import Array
from rths_engine.diagnosis.free import Number, moved, numbers, vector
from rths_engine.diagnosis.noise import Noise
from rths_engine.part import Part

DIFFERENCE = 1e-3  # of a number's scale: wide beside the kinks of friction and play
EVALUATIONS = 40
CLOSE = 1e-6  # of the squared misfit: far below the 1 that evidence weighs


@dataclass(frozen=True)
class Recordings:
    """What a component is fitted to: its data, the measured output, which samples count, and the noise."""

    component: Any
    data: tuple[Any, ...]
    masks: tuple[NDArray[np.bool_], ...]  # True where fitted
    noise: Noise

    def residuals(self, parts: Sequence[Part]) -> list[Array]:
        return [self.component.measured(one) - self.component.predicted(parts, one) for one in self.data]

    def misfit(self, parts: Sequence[Part]) -> Array:
        """Whitened residuals of the fitted samples in a row."""
        return self.joined(self.residuals(parts))

    def joined(self, signals: Sequence[Array]) -> Array:
        rows = [self.noise.whitened(one)[mask] for one, mask in zip(signals, self.masks, strict=True)]
        return np.concatenate(rows)


@dataclass(frozen=True)
class Fitted:
    """A model fitted: its parts, the squared misfit in units of the noise, and the Jacobian of the whitened misfit."""

    parts: tuple[Part, ...]
    free: tuple[Number, ...]
    z: Array
    misfit: Array
    jacobian: Array

    @property
    def squared(self) -> float:
        return float(self.misfit @ self.misfit)

    @property
    def bic(self) -> float:
        """chi^2 + k ln N."""
        return self.squared + len(self.free) * float(np.log(len(self.misfit)))


def fit(recordings: Recordings, parts: Sequence[Part], evaluations: int = EVALUATIONS) -> Fitted:
    """The least squares of the whitened misfit over every free number of the parts, from where they are."""
    free, misfit, start, bounds = _problem(recordings, parts)
    if not free:
        return evaluated(recordings, parts)
    solved = least_squares(misfit, start, bounds=bounds.T, diff_step=DIFFERENCE, max_nfev=evaluations, ftol=CLOSE, xtol=CLOSE)
    return Fitted(tuple(moved(parts, free, solved.x)), tuple(free), solved.x, solved.fun, solved.jac)


def evaluated(recordings: Recordings, parts: Sequence[Part]) -> Fitted:
    """The parts as they are, with the misfit's Jacobian."""
    free, misfit, start, bounds = _problem(recordings, parts)
    plain = misfit(start)
    columns = []
    for place in range(len(free)):
        size = DIFFERENCE * max(1.0, abs(start[place]))
        size = size if start[place] + size <= bounds[place, 1] else -size
        columns.append((misfit(start + size * np.eye(len(free))[place]) - plain) / size)
    jacobian = np.column_stack(columns) if columns else np.zeros((len(plain), 0))
    return Fitted(tuple(parts), tuple(free), start, plain, jacobian)


def _problem(recordings: Recordings, parts: Sequence[Part]) -> tuple[list[Number], Callable[[Array], Array], Array, Array]:
    free = numbers(parts)
    bounds = np.array([number.bounds for number in free]).reshape(-1, 2)
    start = np.clip(vector(parts, free), bounds[:, 0] + 1e-9, bounds[:, 1] - 1e-9)

    def misfit(z: Array) -> Array:
        return recordings.misfit(moved(parts, free, z))

    return free, misfit, start, bounds
