"""90 % intervals of the parameters of a fitted model, by the profile of the likelihood."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from scipy.stats import chi2

from rths_engine.diagnosis.fitting import Fitted, Recordings, problem
from rths_engine.diagnosis.parallel import each
from rths_engine.foundation.arrays import Array
from rths_engine.parts import physics
from rths_engine.parts.physics.effect import Effect

# chosen; see docs/decisions/0023
RISE = float(chi2.ppf(0.9, 1))  # of chi^2, of one number: its 90 % quantile, by definition of the interval
NORMAL_90 = RISE**0.5  # standard deviations each way
DOUBLINGS, HALVINGS, TURNS = 7, 4, 2


def deviations(fitted: Fitted, misfits: Array) -> Array:
    """Standard deviation of z of each free parameter: the scatter of first-order fits to the noise of `misfits` (B, N)."""
    moved = np.linalg.lstsq(fitted.jacobian, misfits.T, rcond=None)[0]
    found: Array = np.std(moved, axis=1, ddof=1)
    return found


def ranges(recordings: Recordings, fitted: Fitted, misfits: Array, temper: float) -> list[tuple[float, float]]:
    """90 % interval of z of each free parameter.

    The interval of an effect's parameter ends where chi^2, with all other parameters refitted, has risen by the amount that
    noise (`misfits`) and the errors of the models (`temper`, the ratio of their chi^2 to that of noise) allow. The uncertainty
    of the parameters that the fit holds fixed widens it.
    """
    first = len(recordings.component.base)
    own = deviations(fitted, misfits) * np.sqrt(temper)
    plain = np.sqrt(np.maximum(np.diag(np.linalg.pinv(fitted.jacobian.T @ fitted.jacobian)), 1e-300))
    held = _held(recordings, fitted)
    profile = _profile(recordings, fitted)

    def interval(place: int) -> tuple[float, float]:
        z, near = float(fitted.z[place]), NORMAL_90 * float(own[place])
        low = high = near
        if fitted.free[place].owner >= first and near > 0:
            rise = RISE * float(own[place] / plain[place]) ** 2
            low, high = (max(near, _reach(lambda off: profile(place, off), way, near, rise)) for way in (-1.0, 1.0))
        more = NORMAL_90 * float(held[place])
        return z - float(np.hypot(low, more)), z + float(np.hypot(high, more))

    return each(interval, range(len(fitted.free)))


def _profile(recordings: Recordings, fitted: Fitted) -> Callable[[int, float], float]:
    """The rise of chi^2 where one parameter is changed and the others are refitted by Gauss-Newton steps."""
    _, misfit, _, bounds = problem(recordings, fitted.parts, fitted.free)
    least = float(fitted.misfit @ fitted.misfit)

    def rise(place: int, off: float) -> float:
        others = [one for one in range(len(fitted.free)) if one != place]
        slopes = fitted.jacobian[:, others]
        z = fitted.z.copy()
        z[place] = np.clip(z[place] + off, *bounds[place])
        z[others] -= np.linalg.lstsq(slopes, fitted.jacobian[:, place] * (z[place] - fitted.z[place]), rcond=None)[0]
        best = np.inf
        for turn in range(TURNS):
            z = np.clip(z, bounds[:, 0], bounds[:, 1])
            now = misfit(z)
            best = min(best, float(now @ now) - least)
            if turn + 1 < TURNS and others:
                z[others] -= np.linalg.lstsq(slopes, now, rcond=None)[0]
        return best

    return rise


def _reach(rise: Callable[[float], float], way: float, near: float, most: float) -> float:
    """The distance in the direction `way` at which chi^2 has risen by `most`; `near` is its first-order estimate."""
    offs = near * 2.0 ** np.arange(DOUBLINGS)
    allowed = [off for off in offs if rise(way * off) <= most]  # all are tried: the profile of a time has barriers
    inside = max(allowed, default=0.0)
    outside = 2 * inside if allowed else near
    for _ in range(HALVINGS):
        middle = (inside + outside) / 2
        inside, outside = (inside, middle) if rise(way * middle) > most else (middle, outside)
    return outside


def _held(recordings: Recordings, fitted: Fitted) -> Array:
    """Change of each free parameter for other plausible values of the held parameters: root of the sum of squares."""
    squares = np.zeros(len(fitted.free))
    first = len(recordings.component.base)
    before = recordings.misfit(fitted.parts)
    for place, part in enumerate(fitted.parts[first:], start=first):
        assert isinstance(part, Effect)
        for name, value in physics.SEARCHES[type(part)].otherwise.items():
            parts = [*fitted.parts]
            parts[place] = part.model_copy(update={name: value})
            change = recordings.misfit(parts) - before
            squares += np.linalg.lstsq(fitted.jacobian[: len(change)], change, rcond=None)[0] ** 2
    return np.sqrt(squares)
