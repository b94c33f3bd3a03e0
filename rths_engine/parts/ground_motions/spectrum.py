"""Pseudo-acceleration response spectrum Sa = w^2 max |u| of u'' + 2 d w u' + w^2 u = -a(t), u at rest before the record.

Exact for acceleration that is linear between samples, as Nigam and Jennings (1969, BSSA 59, 909-922), here in complex form:
z = v - conj(p) u with p = w (-d + i sqrt(1 - d^2)) obeys one first-order recurrence, which runs as a digital filter. The peak
is taken at points at most T/20 apart (a peak between them is at most 1.3 % higher), up to one period after the record.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import Issue, RthsError
from rths_engine.parts.ground_motions.record import Motion

# chosen; see docs/decisions/0023
_POINTS_A_PERIOD = 20
_FINEST = 32  # parts of one step: for periods below dt / 2 the response follows the record, and finer parts give no higher peak


def response_spectrum(acceleration: ArrayLike, dt: float, periods: ArrayLike, damping: float = 0.05) -> Array:
    """Sa (m/s^2) at each period (s) for `acceleration` (m/s^2) every `dt` (s); Sa(0) is the peak of the record.

    Raises RthsError for a negative period or a damping ratio outside [0, 1).
    """
    samples, at = np.asarray(acceleration, dtype=float), np.asarray(periods, dtype=float)
    if not (np.all(np.isfinite(at)) and np.all(at >= 0)):
        raise RthsError(Issue("periods", "needs periods >= 0 s"))
    if not 0 <= damping < 1:
        raise RthsError(Issue("damping", "needs a damping ratio >= 0 and < 1", damping))
    if not (np.isfinite(dt) and dt > 0):
        raise RthsError(Issue("dt", "needs a step > 0 s", dt))
    finer: dict[int, Array] = {}
    return np.array([_peak(samples, dt, period, damping, finer) for period in at.ravel()]).reshape(at.shape)


def spectral_acceleration(motion: Motion, period: float, damping: float = 0.05) -> float:
    """Sa (m/s^2) of `motion` at `period` (s)."""
    return float(response_spectrum(motion.acceleration, motion.dt, [period], damping)[0])


def _peak(samples: Array, dt: float, period: float, damping: float, finer: dict[int, Array]) -> float:
    if period == 0:
        return float(np.max(np.abs(samples)))
    parts = int(2 ** np.clip(np.ceil(np.log2(_POINTS_A_PERIOD * dt / period)), 0, np.log2(_FINEST)))
    if parts not in finer:
        steps = np.arange((len(samples) - 1) * parts + 1) / parts
        finer[parts] = np.interp(steps, np.arange(len(samples)), samples)
    w = 2 * np.pi * dt / (parts * period)
    forced = np.concatenate([finer[parts], np.zeros(int(np.ceil(2 * np.pi / w)) + 1)])
    return float(w**2 * np.max(np.abs(_displacement(forced, w, damping))))


def _displacement(samples: Array, w: float, damping: float) -> Array:
    """Displacement u / step^2 at each sample, for w = omega * step.

    u = Im z / Im p, where z' = p z - a in time counted in steps.
    """
    from scipy.signal import lfilter  # imported here: it takes 1 s, which a run with a scale factor does not need

    pole = w * complex(-damping, np.sqrt(1 - damping**2))
    grown = np.expm1(pole)
    by_second = -(grown - pole) / pole**2
    by_first = -grown / pole - by_second
    at_rest = np.array([-by_second * samples[0]])  # z = 0 at the first sample
    z = lfilter([by_second, by_first], [1.0, -1.0 - grown], samples, zi=at_rest)[0]
    displacement: Array = z.imag / pole.imag
    return displacement
