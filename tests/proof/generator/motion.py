"""Motions: smooth functions of time with exact derivatives."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import PPoly, make_interp_spline

Array = NDArray[np.floating[Any]]
STEP = 1 / 512  # s, between the knots
REST = 1.0  # s without motion at both ends, from which a reader may learn the noise


class Motion:
    """x(t) through knots, as a quintic spline: x, x' and x'' are continuous and exactly consistent."""

    def __init__(self, knots: Array, step: float = STEP) -> None:
        self.step, self.duration = step, (len(knots) - 1) * step
        spline = make_interp_spline(np.arange(len(knots)) * step, knots, k=5)
        grid = np.arange(len(knots)) * step
        self.spline = spline
        pieces = PPoly.from_spline(spline)
        places = np.clip(np.searchsorted(pieces.x, grid[:-1], side="right") - 1, 0, len(pieces.x) - 2)
        shift = grid[:-1] - pieces.x[places]
        derivatives = [pieces.derivative(order)(pieces.x[places] + shift) for order in range(6)]
        factorial = [1, 1, 2, 6, 24, 120]
        self._rows = np.column_stack([one / by for one, by in zip(derivatives, factorial, strict=True)]).tolist()
        self._last = len(self._rows) - 1

    def __call__(self, time: float) -> tuple[float, float, float]:
        """x, x', x'' at one time."""
        place = min(max(int(time / self.step), 0), self._last)
        s = time - place * self.step
        a, b, c, d, e, f = self._rows[place]
        x = a + s * (b + s * (c + s * (d + s * (e + s * f))))
        v = b + s * (2 * c + s * (3 * d + s * (4 * e + s * 5 * f)))
        return x, v, 2 * c + s * (6 * d + s * (12 * e + s * 20 * f))

    def sample(self, time: Array, order: int = 0) -> Array:
        return np.asarray(self.spline.derivative(order)(time) if order else self.spline(time))

    def turning(self) -> Array:
        """The times at which x' changes its sign."""
        return np.sort(PPoly.from_spline(self.spline.derivative(1)).roots(discontinuity=False, extrapolate=False))


def random_motion(random: np.random.Generator, kind: str, peak: float, duration: float) -> Motion:
    """A motion of the given peak, at rest at both ends: `earthquake`, `noise`, `sweep` or `cycles`."""
    time = np.arange(round(duration / STEP) + 1) * STEP
    low, high = random.uniform(0.15, 0.4), random.uniform(1.5, 4.0)
    if kind in ("earthquake", "noise"):
        tones = np.exp(random.uniform(np.log(low), np.log(high), 60))
        decay = 1.0 if kind == "noise" else (tones / low) ** -0.5
        phases = random.uniform(0, 2 * np.pi, 60)
        wave = sum(w * np.sin(2 * np.pi * f * time + p) for w, f, p in zip(decay * np.ones(60), tones, phases, strict=True))
        if kind == "earthquake":
            rise, fall = random.uniform(0.1, 0.25) * duration, random.uniform(0.3, 0.5) * duration
            wave = wave * (time / rise) ** 2 * np.exp(-np.maximum(time - rise, 0.0) / fall) / (1 + (time / rise) ** 2)
    elif kind == "sweep":
        wave = np.sin(2 * np.pi * (low * time + (high - low) * time**2 / (2 * duration))) * (1 - 0.6 * time / duration)
    else:
        frequency = random.uniform(0.4, 1.2)
        levels = np.interp(4 * time / duration, [0.85, 1.15, 1.85, 2.15, 2.85, 3.15], [0.25, 0.5, 0.5, 0.75, 0.75, 1.0])
        wave = np.sin(2 * np.pi * frequency * time) * levels
    wave = np.asarray(wave) * tapered(time, duration)
    return Motion(peak * wave / np.max(np.abs(wave)))


def tapered(time: Array, duration: float) -> Array:
    """0 for REST at both ends, 1 within, by a polynomial of continuous second derivative."""
    edge = np.clip((np.minimum(time, duration - time) - REST) / 1.5, 0.0, 1.0)
    return np.asarray(edge**3 * (10 - 15 * edge + 6 * edge**2))
