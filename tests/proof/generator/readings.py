"""Errors of a sensor, which convert a true signal to its reading."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.interpolate import CubicSpline

from tests.proof.generator.motion import Array

READINGS = ("offset", "drift", "scale_error", "time_skew", "clipping", "dropout")


@dataclass
class Reading:
    """y = (1 + e) w(t - T) + o + r t, limited to +- limit, and held at its value at t_0 for the duration D."""

    offset: float = 0.0
    drift: float = 0.0
    scale_error: float = 0.0
    time_skew: float = 0.0
    clipping: float = np.inf
    begin: float = 0.0
    dropout: float = 0.0

    def read(self, true: Array, time: Array) -> Array:
        """A late signal by a cubic spline through the samples: exact to the fourth order of the step."""
        late = CubicSpline(time, true)(np.clip(time - self.time_skew, time[0], time[-1])) if self.time_skew else true
        read = (1 + self.scale_error) * late + self.offset + self.drift * time
        read = np.clip(read, -self.clipping, self.clipping)
        lost = (time > self.begin) & (time <= self.begin + self.dropout)
        return np.asarray(np.where(lost, np.interp(self.begin, time, read), read))


def reading(
    random: np.random.Generator, name: str, size: float, peak: float, duration: float
) -> tuple[Reading, dict[str, float]]:
    """An error of about `size` times the peak; its parameters have the names of the library."""
    sign = float(random.choice([-1.0, 1.0]))
    match name:
        case "offset":
            return Reading(offset=sign * size * peak), {"error": sign * size * peak}
        case "drift":
            rate = sign * size * peak / duration
            return Reading(drift=rate), {"rate": rate}
        case "scale_error":
            return Reading(scale_error=sign * size), {"share": sign * size}
        case "time_skew":
            delay = sign * size * 0.1
            return Reading(time_skew=delay), {"delay": delay}
        case "clipping":
            limit = (1 - size) * peak
            return Reading(clipping=limit), {"limit": limit}
        case _:
            begin, lasting = duration * random.uniform(0.2, 0.7), size * 5.0
            return Reading(begin=begin, dropout=lasting), {"time": begin, "duration": lasting}
