"""Models of an actuator, fitted to a command and the measured displacement by least squares, with 95 % intervals."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy import optimize, signal

from rths_engine.foundation.arrays import Array
from rths_engine.parts.actuators.second_order import SecondOrderActuator
from rths_engine.running import passes

# chosen; see docs/decisions/0023
WITHIN = 1.96  # standard deviations of a 95 % interval of the normal distribution
SEGMENT = 4.0  # s, of the spectra
TIES = 1.05  # times the smallest residual: a model with fewer parameters is preferred
CORRELATED = 2.0  # periods of the highest frequency, over which the residual may be correlated
LAGS = 8  # blocks of samples in this time
EVALUATIONS = 40  # of a fit, at most
LATEST = 0.2  # s, longest delay that is looked for
BOUND = 0.02  # relative distance to a bound below which a fitted parameter lies at it


@dataclass(frozen=True, slots=True)
class Value:
    """An estimate and its 95 % interval, in SI."""

    value: float
    low: float
    high: float

    @classmethod
    def about(cls, value: float, deviation: float) -> Value:
        return cls(value, value - WITHIN * deviation, value + WITHIN * deviation)

    def within(self, low: float, high: float) -> Value:
        """The interval cut to the bounds of its parameter."""
        return Value(self.value, max(low, self.low), min(high, self.high))


@dataclass(frozen=True, slots=True)
class Fitted:
    """A fitted model. `residual` is the RMS of the residual over the RMS of the measured displacement.

    `undetermined` names the parameters that the test does not determine, because it reaches a bound.
    """

    kind: str
    values: dict[str, Value]
    delay: Value  # s, of slow motion
    residual: float
    undetermined: frozenset[str] = frozenset()


def first_order(u: Array, y: Array, dt: float, high: float, delay: float) -> Fitted:
    """Equation (5a), y[q] = y[q-1] + (u[q] - y[q-1]) / alpha, whose output is fitted to y: noise of y leaves no bias."""

    def moved(given: Array) -> Array:
        share = 1 / max(given[0], 1.0)
        found: Array = signal.lfilter([share], [1.0, share - 1.0], u)
        return found

    found, deviations = _fit(moved, y, [1 + delay / dt], [[1.0], [1 + LATEST / dt]], dt, high)
    alpha = Value.about(float(found[0]), float(np.sqrt(deviations[0, 0])))
    late = Value(*((bound - 1) * dt for bound in (alpha.value, alpha.low, alpha.high)))
    return Fitted("first_order", {"alpha": alpha}, late, _residual(moved(found), y))


def second_order(u: Array, y: Array, dt: float, high: float, delay: float) -> Fitted:
    """Gain, natural frequency, damping ratio and dead time of a second-order actuator, whose output is fitted to y."""

    def moved(given: Array) -> Array:
        gain, frequency, damping, dead = (float(value) for value in given)
        part = SecondOrderActuator(
            frequency=frequency, damping_ratio=damping, dead_time=max(dead, 0.0), velocity_limit=10.0, force_limit=1e8
        )
        return gain * passes.act(part, u, np.zeros_like(u), dt)

    bounds = [[0.2, 1.0, 0.1, 0.0], [5.0, min(200.0, 0.2 / dt), 10.0, 0.1]]
    late = max(delay, 2 * dt)
    starts = [(25.0, 0.5 * late * math.pi * 25.0, 0.5 * late), (60.0, 0.9 * late * math.pi * 60.0, 0.1 * late)]
    inside = [np.clip([1.0, *start], np.array(bounds[0]) + 1e-6, np.array(bounds[1]) - 1e-6) for start in starts]
    fits = [_fit(moved, y, given, bounds, dt, high) for given in inside]
    found, covariance = min(fits, key=lambda fit: _residual(moved(fit[0]), y))
    gain, frequency, damping, dead = (float(value) for value in found)
    deviations = np.sqrt(np.diag(covariance))
    lag = damping / (math.pi * frequency)
    slope = np.array([0.0, -lag / frequency, 1 / (math.pi * frequency), 1.0])
    whole = Value.about(dead + lag, math.sqrt(max(0.0, float(slope @ covariance @ slope))))
    named = zip(("gain", "frequency", "damping_ratio", "dead_time"), (gain, frequency, damping, dead), deviations, strict=True)
    values = {
        name: Value.about(value, float(deviation)).within(low, high)
        for (name, value, deviation), low, high in zip(named, *bounds, strict=True)
    }
    return Fitted("second_order", values, whole, _residual(moved(found), y), _at_bounds(values, *bounds))


def _at_bounds(values: dict[str, Value], lowest: list[float], highest: list[float]) -> frozenset[str]:
    """Parameters of a second-order actuator that lie at a bound, or whose interval reaches it.

    Frequency, damping and dead time are known only together. A dead time of zero is none, and no bound of the search.
    """
    near = {
        name
        for (name, one), low, high in zip(values.items(), lowest, highest, strict=True)
        if max(one.value / (1 - BOUND), one.high) >= high or (low > 0 and min(one.value / (1 + BOUND), one.low) <= low)
    }
    together = {"frequency", "damping_ratio", "dead_time"}
    return frozenset(near | together if near & together else near)


def pure_delay(u: Array, y: Array, dt: float, low: float, high: float) -> tuple[Fitted, float]:
    """The delay from the slope of the phase between `low` and `high` (Hz), and the mean coherence of this band."""
    length = min(len(u), round(SEGMENT / dt))
    frequency, cross = signal.csd(u, y, 1 / dt, nperseg=length)
    power = signal.welch(u, 1 / dt, nperseg=length)[1]
    measured = signal.welch(y, 1 / dt, nperseg=length)[1]
    band = (frequency >= low) & (frequency <= high)
    f, cross, power, measured = frequency[band], cross[band], power[band], measured[band]
    coherence = np.clip(np.abs(cross) ** 2 / (power * measured), 1e-6, 1 - 1e-9)
    segments = max(1, 2 * len(u) // length - 1)
    variance = (1 - coherence) / (2 * segments * coherence)  # of the phase; Bendat and Piersol (2010), equation (9.91)
    phase = np.unwrap(np.angle(cross))
    phase -= 2 * np.pi * round(float(phase[0]) / (2 * np.pi))
    turn = -2 * np.pi * f
    size = float(np.sum(turn**2 / variance))
    late = float(np.sum(turn * phase / variance)) / size
    misfit = float(np.sum((phase - turn * late) ** 2 / variance)) / max(1, len(f) - 1)
    gain = float(np.sqrt(np.sum(measured * coherence) / np.sum(power)))
    value = Value.about(late, math.sqrt(max(1.0, misfit) / size))
    steps = np.arange(len(u))
    shifted = gain * np.interp(steps - late / dt, steps, u, left=0.0)
    return Fitted("pure_delay", {"delay": value}, value, _residual(shifted, y)), float(np.mean(coherence))


def best(fitted: list[Fitted]) -> Fitted:
    """The model with the smallest residual; of nearly equal ones, the one with the fewest parameters."""
    least = min(one.residual for one in fitted)
    near = [one for one in fitted if one.residual <= TIES * least + 1e-9]
    return min(near, key=lambda one: len(one.values))


def _fit(
    moved: Callable[[Array], Array], y: Array, start: object, bounds: object, dt: float, high: float
) -> tuple[Array, Array]:
    """Least squares of y - moved(x), and the covariance of x with a residual that is correlated over a few periods.

    Source: Newey and West (1987), Econometrica 55, 703-708: (J'J)^-1 S (J'J)^-1 with the Bartlett window, over sums of blocks
    of samples. It is at least the covariance of a white residual.
    """
    size = float(np.sqrt(np.mean(y**2))) or 1.0  # tolerances of the search are absolute: residuals are of the order of 1
    found = optimize.least_squares(
        lambda x: (moved(x) - y) / size, start, bounds=bounds, x_scale="jac", diff_step=1e-4, max_nfev=EVALUATIONS
    )
    jacobian, residual = found.jac, found.fun
    block = max(1, round(CORRELATED / (high * dt) / LAGS))
    moments = jacobian * residual[:, None]
    sums = np.add.reduceat(moments, np.arange(0, len(moments), block))
    spread = sums.T @ sums
    for lag in range(1, LAGS):
        shared = sums[lag:].T @ sums[:-lag]
        spread += (1 - lag / LAGS) * (shared + shared.T)
    inverse = np.linalg.pinv(jacobian.T @ jacobian)
    covariance: Array = inverse @ spread @ inverse
    white = np.diag(inverse) * float(np.mean(residual**2))
    wider = max(1.0, float(np.max(white / np.maximum(np.diag(covariance), 1e-300))))
    return found.x, covariance * (wider if np.isfinite(wider) and float(np.max(white)) > 0 else 1.0)


def _residual(moved: Array, y: Array) -> float:
    return float(np.sqrt(np.sum((moved - y) ** 2) / np.sum(y**2)))
