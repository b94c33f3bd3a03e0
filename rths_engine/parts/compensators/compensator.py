"""The base class of a delay compensator, and what a laboratory knows of a transfer system before a test."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar, Self

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import Part

# chosen; see docs/decisions/0023
MOST_FREQUENCY = 100.0  # Hz, up to which the phase crossover is looked for
FREQUENCIES = 4000


@dataclass(frozen=True, slots=True)
class TransferSystem:
    """A transfer system (actuator with its specimen) as it was identified: d_m / d_p = N(s) / D(s), N(0) and D(0) not zero.

    `numerator` and `denominator` are the coefficients of N and D, highest power of s first. `rate` is the controller rate (Hz)
    and `step` the integration step (s) over which the command is a ramp. `displacement` (m) and `velocity` (m/s) are the RMS of
    the motion that the test is expected to command, `displacement_noise` (m) is the standard deviation of its sensor.
    """

    numerator: tuple[float, ...]
    denominator: tuple[float, ...]
    rate: float
    step: float
    displacement: float
    velocity: float
    displacement_noise: float = 0.0

    @property
    def dt(self) -> float:
        """Controller step (s)."""
        return 1.0 / self.rate

    @property
    def gain(self) -> float:
        """Amplitude at rest, N(0) / D(0)."""
        return self.numerator[-1] / self.denominator[-1]

    @property
    def delay(self) -> float:
        """Delay (s) at low frequency: that of the phase at rest."""
        inverse = self.inverse(1)
        return inverse[1] / inverse[0]

    def inverse(self, order: int) -> tuple[float, ...]:
        """a_0 ... a_order of D(s) / N(s) = a_0 + a_1 s + a_2 s^2 + ...: d_p = a_0 d_c + a_1 d_c' + a_2 d_c'' follows d_c."""
        above, below = _ascending(self.denominator, order), _ascending(self.numerator, order)
        found: list[float] = []
        for i in range(order + 1):
            found.append((above[i] - sum(below[i - j] * found[j] for j in range(i))) / below[0])
        return tuple(found)

    @property
    def critical_gain(self) -> float:
        """The proportional gain on the tracking error at which the loop of feedback becomes unstable; infinite if none does."""
        s = 2j * math.pi * np.geomspace(MOST_FREQUENCY / FREQUENCIES, MOST_FREQUENCY, FREQUENCIES)
        response: Array = np.polyval(self.numerator, s) / np.polyval(self.denominator, s) * np.exp(-s * self.dt)
        late = np.flatnonzero(np.unwrap(np.angle(response)) <= -math.pi)
        return float(1 / abs(response[late[0]])) if len(late) else math.inf


def _ascending(coefficients: tuple[float, ...], order: int) -> list[float]:
    given = list(reversed(coefficients))[: order + 1]
    return given + [0.0] * (order + 1 - len(given))


class Compensating(Part):
    """A delay compensator. `tuned_for` gives its settings for a transfer system, by a rule that each compensator states.

    `adaptive` says whether its coefficients change during a test; a stability prediction holds them at their start values.
    """

    adaptive: ClassVar[bool] = False

    @classmethod
    def tuned_for(cls, system: TransferSystem) -> Self:
        """The compensator for a transfer system. Without a rule of its own: its default settings."""
        return cls()
