"""Ground motions and their errors."""

from __future__ import annotations

import math

import numpy as np

from tests.proof.generator.motion import STEP, Array, Motion, tapered


class Ground:
    """A ground acceleration with errors: (1 + e) a(t - T) through a first-order low-pass, plus b + c t."""

    def __init__(self, motion: Motion | None, errors: dict[str, float]) -> None:
        self.scale, self.shift, self.offset, self.rate = (errors.get(key, 0.0) for key in ("scale", "shift", "offset", "rate"))
        self.motion = passed(motion, errors["low_pass"]) if motion and "low_pass" in errors else motion

    def __call__(self, time: Array) -> Array:
        drift = self.offset + self.rate * time
        if self.motion is None:
            return drift
        felt = self.motion.sample(np.clip(time - self.shift, 0.0, self.motion.duration))
        return np.asarray((1 + self.scale) * felt + drift)


def passed(motion: Motion, constant: float) -> Motion:
    """T y' + y = a, exact for a linear between quarter knots."""
    fine = np.arange(0.0, motion.duration + motion.step / 8, motion.step / 4)
    a, h = motion.sample(fine), motion.step / 4
    decay, out = math.exp(-h / constant), [0.0]
    share = constant / h * (1 - decay)
    for before, now in zip(a[:-1].tolist(), a[1:].tolist(), strict=True):
        out.append(decay * out[-1] + (share - decay) * before + (1 - share) * now)
    return Motion(np.array(out)[::4], motion.step)


def shaking(random: np.random.Generator, peak: float, duration: float) -> Motion:
    """An earthquake-like ground acceleration between 0.3 and 12 Hz."""
    time = np.arange(round(duration / STEP) + 1) * STEP
    tones = np.exp(random.uniform(np.log(0.3), np.log(12.0), 80))
    weight = 1 / (1 + (tones / random.uniform(1.5, 4.0)) ** 2)
    phases = random.uniform(0, 2 * np.pi, 80)
    wave = sum(w * np.sin(2 * np.pi * f * time + p) for w, f, p in zip(weight, tones, phases, strict=True))
    rise, fall = 0.15 * duration, 0.3 * duration
    wave = np.asarray(wave) * np.exp(-np.maximum(time - 2 * rise, 0.0) / fall) * tapered(time, duration)
    return Motion(peak * wave / np.max(np.abs(wave)))
