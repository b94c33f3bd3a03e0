"""The linear model of an actuator that model-based compensators begin with: gain, dead time and a second-order system."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.parts.compensators.compensator import TransferSystem

# chosen; see docs/decisions/0023
DEAD_TIMES = 400  # tried between none and the whole delay
MOST_DAMPED = 9.0  # largest damping ratio of a model of a transfer system
HIGHEST = 900.0  # Hz, largest natural frequency of such a model
LEAST_DAMPED = 0.01  # smallest damping ratio of such a model
LOWEST = 0.1  # Hz, smallest natural frequency of such a model


class ActuatorModel(NamedTuple):
    """The model G(s) = gain exp(-T s) / (1 + 2 zeta s / omega + s^2 / omega^2), omega in rad/s and the dead time T in s."""

    gain: float
    omega: float
    damping_ratio: float
    dead_time: float

    @classmethod
    def of(cls, part: object) -> ActuatorModel:
        """The model that a compensator's fields gain, delay (s), frequency (Hz) and damping_ratio describe.

        The delay is that of slow motion, T + 2 zeta / omega. Where 2 zeta / omega alone exceeds it, omega is raised to
        2 zeta / delay and T = 0.
        """
        gain, delay, frequency, damping = (getattr(part, name) for name in ("gain", "delay", "frequency", "damping_ratio"))
        omega = 2 * math.pi * frequency
        if 2 * damping > omega * delay:
            return cls(gain, 2 * damping / delay if delay > 0 else math.inf, damping, 0.0)
        return cls(gain, omega, damping, delay - 2 * damping / omega)

    def inverse(self) -> Array:
        """Coefficients a (4) of 1 / G(s) = a0 + a1 s + a2 s^2 + a3 s^3 + ..."""
        late = self.dead_time
        shift = np.array([1.0, late, late**2 / 2, late**3 / 6])
        found: Array = np.convolve(shift, [1.0, 2 * self.damping_ratio / self.omega, 1 / self.omega**2])[:4] / self.gain
        return found


def fields_for(system: TransferSystem) -> dict[str, float]:
    """Gain, delay, frequency and damping ratio of the model of a transfer system.

    They reproduce the inverse series of the system up to s^2 exactly, and the term in s^3 as nearly as the dead time allows.
    """
    a0, a1, a2, a3 = system.inverse(3)
    a1, a2, a3 = a1 / a0, a2 / a0, a3 / a0
    late = np.linspace(0.0, max(a1, 0.0), DEAD_TIMES, endpoint=False)
    first, second = a1 - late, a2 - late * a1 + late**2 / 2
    valid = second > np.maximum((first / (2 * MOST_DAMPED)) ** 2, (2 * math.pi * HIGHEST) ** -2.0)
    valid &= second < np.minimum((first / (2 * LEAST_DAMPED)) ** 2, (2 * math.pi * LOWEST) ** -2.0)
    wrong = np.abs(late**3 / 6 - a1 * late**2 / 2 + a2 * late - a3)
    if a1 <= 0 or not valid.any():
        return {"gain": 1 / a0, "delay": max(a1, 0.0), "frequency": HIGHEST, "damping_ratio": 1.0}
    best = int(np.flatnonzero(valid)[np.argmin(wrong[valid])])
    omega = float(second[best]) ** -0.5
    return {
        "gain": 1 / a0,
        "delay": a1,
        "frequency": omega / (2 * math.pi),
        "damping_ratio": float(first[best]) * omega / 2,
    }
