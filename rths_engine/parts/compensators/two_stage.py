"""Two-stage adaptive compensation: polynomial extrapolation and an adaptive second-order correction."""

from __future__ import annotations

import math
from typing import ClassVar, Literal, Self

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.kernel import compiled
from rths_engine.foundation.part import quantity
from rths_engine.parts.compensators.compensator import Compensating, TransferSystem

# chosen; see docs/decisions/0023
FINEST = 1e-3  # s, step of the derivatives of a smooth command
FILTERS, COEFFICIENTS, COVARIANCE, RINGS = 3, 7, 10, 16  # places in the state
WEIGHTS, SHARE, START, LOW, HIGH, BEGUN = 8, 12, 13, 16, 19, 22  # places in the parameters


@compiled
def _ahead(p, s, ring, newest):
    """The polynomial through the samples in a ring, one coarse delay ahead of its newest sample."""
    spacing, order, length = int(p[0]), int(p[1]), int(p[2])
    x = 0.0
    for i in range(order + 1):
        x += p[WEIGHTS + i] * s[ring + (newest - i * spacing) % length]
    return x


@compiled
def _corrected(p, s, z, v, a):
    """One step of the Kalman filter of the coefficients, whose regressors are z, v and a (m)."""
    c, q = COEFFICIENTS, COVARIANCE
    error = s[FILTERS + 3] - (s[c] * z + s[c + 1] * v + s[c + 2] * a)
    gz = s[q] * z + s[q + 1] * v + s[q + 2] * a
    gv = s[q + 1] * z + s[q + 3] * v + s[q + 4] * a
    ga = s[q + 2] * z + s[q + 4] * v + s[q + 5] * a
    spread = p[7] + z * gz + v * gv + a * ga
    s[c] = min(max(s[c] + gz * error / spread, p[LOW]), p[HIGH])
    s[c + 1] = min(max(s[c + 1] + gv * error / spread, p[LOW + 1]), p[HIGH + 1])
    s[c + 2] = min(max(s[c + 2] + ga * error / spread, p[LOW + 2]), p[HIGH + 2])
    s[q] += p[SHARE] * (p[START] - s[q]) - gz * gz / spread
    s[q + 1] -= p[SHARE] * s[q + 1] + gz * gv / spread
    s[q + 2] -= p[SHARE] * s[q + 2] + gz * ga / spread
    s[q + 3] += p[SHARE] * (p[START + 1] - s[q + 3]) - gv * gv / spread
    s[q + 4] -= p[SHARE] * s[q + 4] + gv * ga / spread
    s[q + 5] += p[SHARE] * (p[START + 2] - s[q + 5]) - ga * ga / spread


class TwoStageAdaptive(Compensating):
    """Two-stage adaptive compensation.

    z(t) = P(t + share tau),  d_p = b . (z, z', z''),  b by a Kalman filter with b constant and d_p = b . (z_m, z_m', z_m'')

    First stage, coarse: P is the polynomial of order n through the commands at distances of the coarse delay share tau. Second
    stage, fine: z_m is the same polynomial through the measured displacement, so that b is the inverse of what the coarse
    stage leaves of the actuator. The filter is a recursive least squares with the covariance G, G -= K (G Phi)',
    K = G Phi / (r^2 + Phi G Phi), and forgets towards its start, G' = (G_0 - G) / memory, so that G stays bounded at rest. r is
    the noise of z_m. d_p and d_m pass two equal first-order low-pass filters before. Derivatives are differences over h;
    with h = one integration step, the kinks of the ramped command do not enter them. Start: b = (1, (1 - share) tau, 0).
    Bounds: |b0 - 1| <= gain_range, |b1| <= tau_max, |b2| <= tau_max^2 / 2.
    State: s[0] (b1 - (1 - share) tau) / dt (recorded as d_alpha), s[1] counter of the rings, s[2] last d_p (m), then filters
    (4), b (3) over powers of the response's circular frequency w_r, G (6), and the rings of d_c, d_m, z and z_m.
    Not valid at frequencies near 1 / (2 share tau) and above, where the coarse stage amplifies 2^(n+1) - 1 times.
    Source: Wang, Ning, Xu, Zhou and Wu (2019), Mech. Syst. Signal Process. 133, 106262; Wang, Yan, Ning and Wu (2020), Shock
    and Vibration, "Test verification of two-stage adaptive delay compensation method"; Kalman filter after Ning, Wang and Wu
    (2020), Appl. Sci. 10, 7101.
    """

    kind: Literal["two_stage"] = "two_stage"
    delay: float = quantity("Estimated delay τ", "s", "ms", ge=0, le=0.2, default=29 / 1024)
    share: float = quantity("Share of the coarse stage", "1", "%", ge=0, le=1, default=0.6)
    order: int = quantity("Order of the polynomial n", ge=1, le=3, default=1)
    largest_delay: float = quantity("Largest delay of the fine stage τ_max", "s", "ms", gt=0, le=0.2, default=0.06)
    gain_range: float = quantity("Range of the amplitude coefficient |b0 − 1|", ge=0, le=0.9, default=0.3)
    response_frequency: float = quantity("Dominant frequency of the response", "Hz", gt=0, le=100, default=1.0)
    memory: float = quantity("Memory of the fine stage", "s", gt=0, le=1000, default=10.0)
    noise: float = quantity("Displacement noise r", "m", "mm", gt=0, le=1, default=0.1e-3)
    derivative_step: float = quantity("Step of the derivatives h", "s", "ms", gt=0, le=0.05, default=10 / 1024)
    cutoff: float = quantity("Low-pass filter before the fine stage", "Hz", gt=0, le=1000, default=10.0)
    title: ClassVar[str] = "Two-stage adaptive"
    adaptive: ClassVar[bool] = True

    @classmethod
    def tuned_for(cls, system: TransferSystem) -> Self:
        """The delay at low frequency, the mean frequency of the expected motion, and derivatives over one integration step."""
        return cls(
            delay=system.delay,
            largest_delay=2 * system.delay,
            response_frequency=system.velocity / (2 * math.pi * system.displacement),
            noise=max(3 * system.displacement_noise, system.displacement / 20),
            derivative_step=max(system.step, system.dt, FINEST),
        )

    def build(self, dt: float) -> tuple[Array, Array]:
        coarse, fine = self.share * self.delay, (1 - self.share) * self.delay
        spacing, step = max(1, round(coarse / dt)), max(1, round(self.derivative_step / dt))
        ahead = coarse / (spacing * dt)
        weights = np.zeros(4)
        for i in range(self.order + 1):
            weights[i] = math.prod((ahead + j) / (j - i) for j in range(self.order + 1) if j != i)
        length, short = self.order * spacing + 1, 2 * step + 1
        pace = 2 * math.pi * self.response_frequency
        smoothing = 1 - math.exp(-2 * math.pi * self.cutoff * dt)
        reach = self.largest_delay * pace
        low = [1 - self.gain_range, -reach, -(reach**2) / 2]
        high = [1 + self.gain_range, reach, reach**2 / 2]
        spread = [self.gain_range**2, reach**2, reach**4 / 4]
        scale = 1 / (pace * step * dt)
        head = [spacing, self.order, length, step, scale, smoothing, 1 / pace, self.noise**2]
        state = np.zeros(RINGS + 2 * length + 2 * short)
        state[COEFFICIENTS : COEFFICIENTS + 2] = 1.0, min(fine * pace, reach)
        state[[COVARIANCE, COVARIANCE + 3, COVARIANCE + 5]] = spread
        return np.array([*head, *weights, min(1.0, dt / self.memory), *spread, *low, *high, state[COEFFICIENTS + 1]]), state

    @staticmethod
    def step(p, s, x_cmd, x_cmd_last, x_meas, ti, dt):
        length, step, c = int(p[2]), int(p[3]), COEFFICIENTS
        short = 2 * step + 1
        newest, now = int(s[1]) % length, int(s[1]) % short
        one, two = (now - step) % short, (now + 1) % short
        s[1] = (s[1] + 1.0) % (length * short)
        s[FILTERS] += p[5] * (x_meas - s[FILTERS])
        s[FILTERS + 1] += p[5] * (s[FILTERS] - s[FILTERS + 1])
        s[FILTERS + 2] += p[5] * (s[2] - s[FILTERS + 2])
        s[FILTERS + 3] += p[5] * (s[FILTERS + 2] - s[FILTERS + 3])
        commands, measured = RINGS, RINGS + length
        coarse, fine = measured + length, measured + length + short
        s[commands + newest], s[measured + newest] = x_cmd, s[FILTERS + 1]
        s[coarse + now] = _ahead(p, s, commands, newest)
        s[fine + now] = _ahead(p, s, measured, newest)
        z, z1, z2 = s[fine + now], s[fine + one], s[fine + two]
        _corrected(p, s, z, (1.5 * z - 2.0 * z1 + 0.5 * z2) * p[4], (z - 2.0 * z1 + z2) * p[4] ** 2)
        s[0] = (s[c + 1] - p[BEGUN]) * p[6] / dt
        z, z1, z2 = s[coarse + now], s[coarse + one], s[coarse + two]
        s[2] = s[c] * z + s[c + 1] * (1.5 * z - 2.0 * z1 + 0.5 * z2) * p[4] + s[c + 2] * (z - 2.0 * z1 + z2) * p[4] ** 2
        return s[2]
