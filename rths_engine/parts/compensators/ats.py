"""Adaptive time series compensation (ATS)."""

from __future__ import annotations

import math
from typing import ClassVar, Literal, Self

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.kernel import compiled
from rths_engine.foundation.part import quantity
from rths_engine.parts.compensators.compensator import Compensating, TransferSystem

# chosen; see docs/decisions/0023
MOST_SAMPLES = 2048  # of the moving window; a longer window skips substeps
MOST_DELAY = 0.2  # s, the bound of the field
FIT_SHARE = 0.4  # of the delay: step of the central differences in the fit
FILTERS, COEFFICIENTS, SUMS, FRESH, PLACE, WINDOW = 5, 9, 12, 21, 30, 31  # places in the state


@compiled
def _accumulate(s, sums, sample, sign):
    """Add `sign` times the products of a sample to nine sums: x x, x x', x x'', x' x', x' x'', x'' x'', x u, x' u, x'' u."""
    x, v, a, u = sign * s[sample], s[sample + 1], s[sample + 2], s[sample + 3]
    s[sums] += x * s[sample]
    s[sums + 1] += x * v
    s[sums + 2] += x * a
    s[sums + 3] += sign * v * v
    s[sums + 4] += sign * v * a
    s[sums + 5] += sign * a * a
    s[sums + 6] += x * u
    s[sums + 7] += sign * v * u
    s[sums + 8] += sign * a * u


@compiled
def _descend(s, own, diagonal, mixed, low, high):
    """Least squares of one coefficient within its bounds, with the others fixed; `mixed` is their part of its equation."""
    if diagonal > 0.0:
        s[COEFFICIENTS + own] = min(max((s[SUMS + 6 + own] - mixed) / diagonal, low), high)


class AdaptiveTimeSeries(Compensating):
    """Adaptive time series compensation (ATS).

    d_p = a0 d_c + a1 d_c' + a2 d_c'',  a minimising the sum over the window of (d_p - a0 d_m - a1 d_m' - a2 d_m'')^2

    Derivatives are backward differences over h: (3 d(t) - 4 d(t-h) + d(t-2h)) / (2h) and (d(t) - 2 d(t-h) + d(t-2h)) / h^2.
    With h = one integration step, the kinks of the ramped command do not enter d_c''. With a `fit_step` h_f, the fit takes
    central differences over h_f at t - h_f, and d_m and d_p there weighted by (1, 4, 1) / 6, so that all lag and smooth alike:
    sensor noise, which pulls a2 towards zero, enters d_m'' less by (h / h_f)^2. Both d_p and d_m pass two equal first-order
    low-pass filters before the fit, which remove most of the sensor noise and do not change their relation.
    The sums of the window add the newest sample and subtract the oldest. They are computed anew once a window, so that
    rounding errors do not accumulate. Each substep makes one sweep of coordinate descent within |a0 - 1| <= gain_range,
    0 <= a1 <= tau_max and 0 <= a2 <= tau_max^2 / 2. The sweeps converge to the bounded least squares, also where the motion is
    a single sine and the normal equations, which the paper inverts, are singular. Start: a = (1, tau, tau^2 / 2), that of a
    pure delay, unless `start_gain` and `acceleration_root` state a0 and the root of a2 of an identified transfer system. The
    coefficients adapt only while the RMS of the measured displacement over the window exceeds the threshold.
    State: s[0] (a1 - tau) / dt (recorded as d_alpha), s[1] substeps since the last sample, s[2] index in the window, s[3] index
    in the delay lines, s[4] last d_p (m), then filters (4), a (3), running and fresh sums (9 each), index in the delay
    lines of the fit, the window (d_m, d_m', d_m'', d_p for each sample), and the delay lines of d_c, filtered d_m and d_p.
    Not valid when the actuator changes faster than the window, or where sensor noise is larger than d_m''.
    Source: Chae, Kazemibidokhti and Ricles (2013), "Adaptive time series compensator for delay compensation of
    servo-hydraulic actuator systems for real-time hybrid simulation", EESD 42, 1697-1715.
    """

    kind: Literal["ats"] = "ats"
    delay: float = quantity("Estimated delay τ", "s", "ms", ge=0, le=0.2, default=29 / 1024, help="start value of a1")
    largest_delay: float = quantity("Largest delay a1, τ_max", "s", "ms", gt=0, le=0.2, default=0.06)
    gain_range: float = quantity("Range of the amplitude coefficient |a0 − 1|", ge=0, le=0.9, default=0.3)
    window: float = quantity("Moving window", "s", ge=0.05, le=10, default=1.0)
    derivative_step: float = quantity("Step of the derivatives h", "s", "ms", gt=0, le=0.05, default=10 / 1024)
    cutoff: float = quantity("Low-pass filter before the fit", "Hz", gt=0, le=1000, default=20.0)
    threshold: float = quantity("Smallest RMS displacement for adaptation", "m", "mm", ge=0, le=1, default=0.25e-3)
    fit_step: float | None = quantity(
        "Step of the central differences in the fit h_f", "s", "ms", gt=0, le=0.05, default=None, help="empty: backward, over h"
    )
    start_gain: float = quantity("Start value of a0", ge=0.1, le=1.9, default=1.0)
    acceleration_root: float | None = quantity(
        "Root of the start value of a2, √a2", "s", "ms", ge=0, le=0.2, default=None, help="empty: τ / √2, that of a pure delay"
    )
    title: ClassVar[str] = "Adaptive time series (ATS)"
    adaptive: ClassVar[bool] = True

    @classmethod
    def tuned_for(cls, system: TransferSystem) -> Self:
        """a0, a1 and a2 start at the inverse of the transfer system; the fit's step is a share of its delay."""
        gain, first, second = system.inverse(2)
        return cls(
            delay=first,
            largest_delay=min(2 * first, MOST_DELAY),
            start_gain=gain,
            acceleration_root=math.sqrt(max(second, 0.0)),
            derivative_step=max(system.step, system.dt),
            fit_step=max(FIT_SHARE * first, system.dt),
            threshold=system.displacement / 2,
        )

    def build(self, dt: float) -> tuple[Array, Array]:
        spacing = max(1, round(self.derivative_step / dt))
        skip = math.ceil(self.window / dt / MOST_SAMPLES)
        samples = max(4, round(self.window / dt / skip))
        smoothing = 1 - math.exp(-2 * math.pi * self.cutoff * dt)
        start = min(self.delay, self.largest_delay)
        low = [1 - self.gain_range, 0.0, 0.0]
        high = [1 + self.gain_range, self.largest_delay, self.largest_delay**2 / 2]
        central = self.fit_step is not None
        lag = max(1, round((self.fit_step or self.derivative_step) / dt))
        parameters = [spacing, spacing * dt, skip, samples, smoothing, samples * self.threshold**2, start, *low, *high]
        state = np.zeros(WINDOW + 4 * samples + 2 * spacing + 1 + 2 * (2 * lag + 1))
        second = start**2 / 2 if self.acceleration_root is None else self.acceleration_root**2
        state[COEFFICIENTS : COEFFICIENTS + 3] = np.clip([self.start_gain, start, second], low, high)
        return np.array([*parameters, lag, lag * dt, float(central)]), state

    @staticmethod
    def step(p, s, x_cmd, x_cmd_last, x_meas, ti, dt):
        spacing, h, samples = int(p[0]), p[1], int(p[3])
        length = 2 * spacing + 1
        commands = WINDOW + 4 * samples
        newest = int(s[3])
        middle, oldest = (newest - spacing) % length, (newest + 1) % length
        s[3] = oldest
        lag, lag_time = int(p[13]), p[14]
        reach = 2 * lag + 1
        measured = commands + length
        sent = measured + reach
        fresh = int(s[PLACE])
        half, full = (fresh - lag) % reach, (fresh + 1) % reach
        s[PLACE] = full
        s[FILTERS] += p[4] * (x_meas - s[FILTERS])
        s[FILTERS + 1] += p[4] * (s[FILTERS] - s[FILTERS + 1])
        s[FILTERS + 2] += p[4] * (s[4] - s[FILTERS + 2])
        s[FILTERS + 3] += p[4] * (s[FILTERS + 2] - s[FILTERS + 3])
        s[measured + fresh] = s[FILTERS + 1]
        s[sent + fresh] = s[FILTERS + 3]
        s[commands + newest] = x_cmd

        s[1] += 1.0
        if s[1] >= p[2]:
            s[1] = 0.0
            sample = WINDOW + 4 * int(s[2])
            _accumulate(s, SUMS, sample, -1.0)
            now, before, first = s[measured + fresh], s[measured + half], s[measured + full]
            s[sample + 2] = (now - 2.0 * before + first) / (lag_time * lag_time)
            if p[15] > 0.0:
                s[sample] = (now + 4.0 * before + first) / 6.0
                s[sample + 1] = (now - first) / (2.0 * lag_time)
                s[sample + 3] = (s[sent + fresh] + 4.0 * s[sent + half] + s[sent + full]) / 6.0
            else:
                s[sample] = now
                s[sample + 1] = (3.0 * now - 4.0 * before + first) / (2.0 * lag_time)
                s[sample + 3] = s[FILTERS + 3]
            _accumulate(s, SUMS, sample, 1.0)
            _accumulate(s, FRESH, sample, 1.0)
            s[2] += 1.0
            if s[2] >= samples:
                s[2] = 0.0
                for k in range(9):
                    s[SUMS + k] = s[FRESH + k]
                    s[FRESH + k] = 0.0

        c = COEFFICIENTS
        if s[SUMS] > p[5]:
            _descend(s, 0, s[SUMS], s[SUMS + 1] * s[c + 1] + s[SUMS + 2] * s[c + 2], p[7], p[10])
            _descend(s, 1, s[SUMS + 3], s[SUMS + 1] * s[c] + s[SUMS + 4] * s[c + 2], p[8], p[11])
            _descend(s, 2, s[SUMS + 5], s[SUMS + 2] * s[c] + s[SUMS + 4] * s[c + 1], p[9], p[12])
        s[0] = (s[c + 1] - p[6]) / dt
        velocity = (3.0 * x_cmd - 4.0 * s[commands + middle] + s[commands + oldest]) / (2.0 * h)
        acceleration = (x_cmd - 2.0 * s[commands + middle] + s[commands + oldest]) / (h * h)
        s[4] = s[c] * x_cmd + s[c + 1] * velocity + s[c + 2] * acceleration
        return s[4]
