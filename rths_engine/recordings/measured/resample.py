"""Resample a signal to equal steps at a rational multiple of its rate: y = x at rate * p / q.

Samples at uneven times are interpolated first. The change of rate uses a zero-phase anti-alias filter (polyphase, Kaiser
window; scipy.signal.resample_poly).

Not valid for frequencies near half of the lower rate, which the filter removes.
"""

from __future__ import annotations

from fractions import Fraction

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import Issue, MeasuredError
from rths_engine.recordings.measured.clock import DRIFT, Clock

# chosen; see docs/decisions/0023
LARGEST_FACTOR = 1000  # between two rates, and in the fraction that approximates their ratio
ON_GRID = 1e-3  # of a step


def resampled(values: Array, clock: Clock, start: float, count: int, dt: float) -> Array:
    """`values` at start + k dt, k < count, all within the time of the clock. Raises MeasuredError for rates too far apart."""
    ratio = clock.step / dt
    if not 1 / LARGEST_FACTOR <= ratio <= LARGEST_FACTOR:
        bound = f"is {max(ratio, 1 / ratio):.4g} times away from the file's {1 / clock.step:.6g} Hz; at most {LARGEST_FACTOR}"
        raise MeasuredError(Issue("mapping.target_rate", bound, f"{1 / dt:.6g} Hz", "choose a rate closer to that of the file"))
    factor = _factor(ratio)
    step = dt * float(factor)
    needed = min(int(np.ceil((count - 1) * dt / step)) + 1, int((clock.last - start) / step + 1 + ON_GRID))
    even = _evenly(values, clock, start, needed, step)
    if factor == 1:
        return even[:count]
    from scipy.signal import resample_poly

    found = resample_poly(even, factor.numerator, factor.denominator, padtype="line")
    short = count - len(found)
    return np.concatenate([found, np.full(short, found[-1])]) if short > 0 else np.asarray(found[:count])


def described(clock: Clock, start: float, count: int, dt: float) -> str:
    """How `resampled` finds its values, in words; empty where they are the values themselves."""
    factor = _factor(clock.step / dt)
    parts = []
    if not clock.uniform:
        parts.append("interpolated to equal steps (modified Akima)")
    elif not _on_grid(clock, start, count, dt * float(factor)):
        parts.append("interpolated between its samples (modified Akima)")
    if factor != 1:
        parts.append(f"from {1 / clock.step:.6g} Hz to {1 / dt:.6g} Hz by a zero-phase polyphase filter")
    return "; ".join(parts)


def _factor(ratio: float) -> Fraction:
    if ratio >= 1:
        return Fraction(ratio).limit_denominator(LARGEST_FACTOR)
    return 1 / Fraction(1 / ratio).limit_denominator(LARGEST_FACTOR)


def _on_grid(clock: Clock, start: float, count: int, step: float) -> bool:
    """Whether start + k step, k < count, are times of the clock."""
    first = (start - clock.start) / clock.step
    return abs(first - round(first)) < ON_GRID and abs(step / clock.step - 1) * count < DRIFT


def _evenly(values: Array, clock: Clock, start: float, count: int, step: float) -> Array:
    """`values` at start + k step: interpolated, or the samples where their times agree."""
    first = (start - clock.start) / clock.step
    if clock.uniform and _on_grid(clock, start, count, step) and round(first) + count <= len(values):
        return values[round(first) : round(first) + count]
    from scipy.interpolate import Akima1DInterpolator

    wanted = np.clip(start + np.arange(count) * step, clock.times[0], clock.times[-1])
    if len(values) < 4:
        return np.asarray(np.interp(wanted, clock.times, values))
    try:
        with np.errstate(over="ignore", invalid="ignore"):
            found = np.asarray(Akima1DInterpolator(clock.times, values, method="makima")(wanted))
    except ValueError:  # its slopes are not finite
        found = np.array([np.nan])
    if not np.isfinite(found).all():
        bound = "has values that are too large to be resampled"
        raise MeasuredError(Issue("mapping.channels", bound, f"{np.max(np.abs(values)):.4g}", "correct the file, or its unit"))
    return found
