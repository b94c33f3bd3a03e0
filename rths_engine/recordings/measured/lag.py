"""The lag between two channels that measure the same thing: y(t) = k x(t - lag) + c + noise.

A coarse lag is where the cross-correlation of the two is largest. Gauss-Newton then minimises the sum of squares over lag, k
and c, with x interpolated by its Fourier series. With g = k dx/dt and R the autocovariance of the residual, the variance of the
lag is g' R g / (g' g)^2 (the estimate of Newey and West 1987, doi:10.2307/1913610).

Not valid where the two differ by more than a lag and a factor: the lag of an actuator's dynamics depends on the frequency.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.fft

from rths_engine.foundation.arrays import Array

# chosen; see docs/decisions/0023
SIMILAR = 0.9  # smallest correlation at the best lag: below it the two channels do not measure the same thing
SHARED = 0.5  # smallest part of the record over which the two channels are compared
LONGEST = 100_000  # samples that are compared; a longer record is compared over its middle
STEPS = 12  # of Gauss-Newton; each divides the error of a smooth signal by far more than two
QUANTILE = 1.959963984540054  # of the normal distribution for 95 % (by definition)


@dataclass(frozen=True, slots=True)
class Lag:
    """The lag (s) of y behind x, its 95 % interval, the factor k, and the correlation of the two at that lag."""

    seconds: float
    low: float
    high: float
    factor: float
    correlation: float

    @property
    def certain(self) -> bool:
        """Whether the interval excludes zero."""
        return self.low > 0 or self.high < 0


def between(x: Array, y: Array, dt: float) -> Lag | None:
    """The lag of y behind x, both at equal steps dt (s); None where they do not measure the same thing or one is constant."""
    x, y = _middle(np.asarray(x, float), np.asarray(y, float))
    x, y = x - x.mean(), y - y.mean()
    if len(x) < 32 or not (np.isfinite(x).all() and np.isfinite(y).all()) or np.ptp(x) == 0 or np.ptp(y) == 0:
        return None
    shift = _coarse(x, y)
    if shift is None:
        return None
    lag = _refined(x, y, float(shift))
    if lag is None or abs(lag.correlation) < SIMILAR:
        return None
    return Lag(lag.seconds * dt, lag.low * dt, lag.high * dt, lag.factor, lag.correlation)


def _middle(x: Array, y: Array) -> tuple[Array, Array]:
    first = max(0, (len(x) - LONGEST) // 2)
    return x[first : first + LONGEST], y[first : first + LONGEST]


def _coarse(x: Array, y: Array) -> int | None:
    """The lag in samples at which the correlation over the shared part is largest in size."""
    from scipy.signal import fftconvolve

    n = len(x)
    products = fftconvolve(y, x[::-1])
    lags = np.arange(-n + 1, n)
    shared = n - np.abs(lags)
    tail_x, tail_y = np.cumsum(x**2), np.cumsum(y**2)
    head_x, head_y = np.concatenate([[0.0], tail_x]), np.concatenate([[0.0], tail_y])
    ahead = np.maximum(lags, 0)  # y from here on meets x from its start
    behind = np.maximum(-lags, 0)
    power_x = head_x[n - ahead] - head_x[behind]
    power_y = head_y[n - behind] - head_y[ahead]
    with np.errstate(divide="ignore", invalid="ignore"):
        size = np.abs(products) / np.sqrt(power_x * power_y)
    size[(shared < SHARED * n) | ~np.isfinite(size)] = 0.0
    return int(lags[np.argmax(size)]) if size.max() > 0 else None


def _refined(x: Array, y: Array, lag: float) -> Lag | None:
    """Lag, factor and interval, in samples."""
    whole = round(lag)
    n = len(x)
    margin = max(8, n // 50)
    first, last = max(0, whole) + margin, n + min(0, whole) - margin
    if last - first < 32:
        return None
    inside = slice(first, last)
    target = y[inside]
    design = np.empty((last - first, 3))
    factor = 1.0
    for _ in range(STEPS):
        moved, slope = _delayed(x, lag)
        design[:, 0], design[:, 1], design[:, 2] = -slope[inside], moved[inside], 1.0
        found, *_ = np.linalg.lstsq(design, target, rcond=None)
        factor = float(found[1])
        if factor == 0 or not np.isfinite(found).all():
            return None
        step = float(np.clip(found[0] / factor, -1.0, 1.0))
        lag += step
        if abs(lag - whole) > margin:
            return None
        if abs(step) < 1e-9:
            break
    moved, slope = _delayed(x, lag)
    part = moved[inside] - moved[inside].mean()
    residual = (target - target.mean()) - factor * part
    spread = _standard_error(residual, factor * (slope[inside] - slope[inside].mean()))
    power = float(part @ part) * float(np.sum((target - target.mean()) ** 2))
    correlation = float(part @ (target - target.mean())) / np.sqrt(power) if power > 0 else 0.0
    return Lag(lag, lag - QUANTILE * spread, lag + QUANTILE * spread, factor, correlation)


def _delayed(x: Array, lag: float) -> tuple[Array, Array]:
    """x(t - lag) and its derivative per sample; the ends are mirrored, so that the Fourier series has no jump."""
    n = len(x)
    pad = min(n - 1, int(abs(lag)) + 64)
    length = scipy.fft.next_fast_len(n + 2 * pad, real=True)
    padded = np.pad(x, (pad, length - n - pad), mode="reflect" if length - n - pad < n else "wrap", reflect_type="odd")
    spectrum = scipy.fft.rfft(padded)
    omega = 2 * np.pi * scipy.fft.rfftfreq(length)
    turned = spectrum * np.exp(-1j * omega * lag)
    both = scipy.fft.irfft(np.stack([turned, 1j * omega * turned]), length, axis=1)
    return both[0, pad : pad + n], both[1, pad : pad + n]


def _standard_error(residual: Array, slope: Array) -> float:
    """sqrt(g' R g) / (g' g) with R the autocovariance of the residual, g the slope: the sandwich estimate by its spectrum."""
    length = scipy.fft.next_fast_len(2 * len(residual), real=True)
    taper = np.zeros(length)
    reach = max(1, int(4 * (len(residual) / 100) ** (2 / 9)) * 8)  # Newey and West 1987, wider: residuals are oversampled
    covariance = scipy.fft.irfft(np.abs(scipy.fft.rfft(residual, length)) ** 2, length) / len(residual)
    taper[:reach] = 1 - np.arange(reach) / reach
    taper[length - reach + 1 :] = taper[reach - 1 : 0 : -1]
    noise = np.maximum(scipy.fft.rfft(covariance * taper).real, 0.0)
    energy = np.abs(scipy.fft.rfft(slope, length)) ** 2
    weights = np.full(len(noise), 2.0)
    weights[0] = 1.0
    if length % 2 == 0:
        weights[-1] = 1.0
    variance = float(np.sum(weights * noise * energy)) / length
    return float(np.sqrt(variance)) / float(slope @ slope)
