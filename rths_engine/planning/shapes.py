"""Shapes of prescribed signals: functions of time that are multiplied by an amplitude."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

import numpy as np
from pydantic import Field, model_validator

from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import Value, quantity

# chosen; see docs/decisions/0023
TONES = 400  # number of tones in band-limited noise
Share = Annotated[float, Field(ge=-1e6, le=1e6)]  # of the amplitude


class Still(Value):
    """The signal is zero: y(t) = 0."""

    kind: Literal["still"] = "still"
    title: ClassVar[str] = "At rest"

    @property
    def duration(self) -> float:
        return 0.0

    def sample(self, time: Array) -> Array:
        return np.zeros_like(time)


class Sine(Value):
    """y(t) = g(t) sin(2 pi f t); g rises and falls as half a cosine at both ends."""

    kind: Literal["sine"] = "sine"
    frequency: float = quantity("Frequency", "Hz", gt=0, le=200, default=0.5)
    cycles: float = quantity("Cycles", gt=0, le=100_000, default=10.0)
    ramps: float = quantity("Ramp cycles at each end", ge=0, le=1000, default=1.0)
    title: ClassVar[str] = "Sine"

    @property
    def duration(self) -> float:
        return self.cycles / self.frequency

    def sample(self, time: Array) -> Array:
        wave = np.sin(2 * np.pi * self.frequency * time)
        return np.asarray(wave * _tapered(time, self.duration, self.ramps / self.frequency))


class Triangle(Value):
    """A triangle wave between -1 and 1 with the constant speed 4 f; it starts upwards from 0."""

    kind: Literal["triangle"] = "triangle"
    frequency: float = quantity("Frequency", "Hz", gt=0, le=200, default=0.1)
    cycles: float = quantity("Cycles", gt=0, le=100_000, default=3.0)
    title: ClassVar[str] = "Triangle (constant velocity)"

    @property
    def duration(self) -> float:
        return self.cycles / self.frequency

    def sample(self, time: Array) -> Array:
        phase = (time * self.frequency + 0.25) % 1.0
        return np.where(time <= self.duration, 1 - 4 * np.abs(phase - 0.5), 0.0)


class IncreasingCycles(Value):
    """Sine cycles at one level after the other, with the same number of cycles at each level."""

    kind: Literal["increasing_cycles"] = "increasing_cycles"
    frequency: float = quantity("Frequency", "Hz", gt=0, le=200, default=0.25)
    levels: tuple[Share, ...] = quantity(
        "Levels as fractions of the amplitude", default=(0.25, 0.5, 0.75, 1.0), min_length=1, max_length=1000
    )
    cycles_each: int = quantity("Cycles at each level", ge=1, le=1000, default=3)
    title: ClassVar[str] = "Cycles of increasing amplitude"

    @property
    def duration(self) -> float:
        return len(self.levels) * self.cycles_each / self.frequency

    def sample(self, time: Array) -> Array:
        level = np.floor(time * self.frequency / self.cycles_each + 1e-9).astype(int)
        share = np.array([*self.levels, 0.0])[np.clip(level, 0, len(self.levels))]
        return np.asarray(share * np.sin(2 * np.pi * self.frequency * time))


class Chirp(Value):
    """y(t) = g(t) sin(2 pi (f_0 t + (f_1 - f_0) t^2 / (2 T))); g rises and falls over one period of the lower frequency."""

    kind: Literal["chirp"] = "chirp"
    start_frequency: float = quantity("First frequency f₀", "Hz", gt=0, le=200, default=0.1)
    end_frequency: float = quantity("Last frequency f₁", "Hz", gt=0, le=200, default=5.0)
    duration: float = quantity("Duration T", "s", gt=0, le=3600, default=40.0)
    title: ClassVar[str] = "Chirp (linear sweep)"

    def sample(self, time: Array) -> Array:
        rate = (self.end_frequency - self.start_frequency) / self.duration
        wave = np.sin(2 * np.pi * (self.start_frequency + rate * time / 2) * time)
        rise = min(1 / min(self.start_frequency, self.end_frequency), self.duration / 4)
        return np.asarray(wave * _tapered(time, self.duration, rise))


class BandNoise(Value):
    """Tones of equal amplitude and random phase between f_0 and f_1, scaled to a peak of 1. The seed determines the tones."""

    kind: Literal["band_noise"] = "band_noise"
    low_frequency: float = quantity("Lowest frequency f₀", "Hz", gt=0, le=200, default=0.1)
    high_frequency: float = quantity("Highest frequency f₁", "Hz", gt=0, le=200, default=3.0)
    duration: float = quantity("Duration", "s", gt=0, le=3600, default=40.0)
    seed: int = Field(0, title="Seed", ge=0, le=2**63 - 1)
    title: ClassVar[str] = "Band-limited noise"

    @model_validator(mode="after")
    def _rising(self) -> BandNoise:
        if self.high_frequency <= self.low_frequency:
            raise ValueError(f"the highest frequency needs to be above the lowest, {self.low_frequency:g} Hz")
        return self

    def sample(self, time: Array) -> Array:
        random = np.random.Generator(np.random.PCG64(self.seed))
        edges = np.linspace(self.low_frequency, self.high_frequency, TONES + 1)
        tones = random.uniform(edges[:-1], edges[1:])
        phases = random.uniform(0, 2 * np.pi, TONES)
        wave: Array = np.zeros_like(time)
        for tone, phase in zip(tones, phases, strict=True):
            wave += np.sin(2 * np.pi * tone * time + phase)
        wave *= _tapered(time, self.duration, min(1 / self.low_frequency, self.duration / 4))
        peak = float(np.max(np.abs(wave), initial=0.0))
        return wave / peak if peak > 0 else wave


class Step(Value):
    """A step from 0 to 1 that rises as half a cosine."""

    kind: Literal["step"] = "step"
    delay: float = quantity("Time of the step", "s", ge=0, le=3600, default=1.0)
    rise: float = quantity("Rise time", "s", gt=0, le=3600, default=0.1)
    duration: float = quantity("Duration", "s", gt=0, le=3600, default=5.0)
    title: ClassVar[str] = "Step"

    def sample(self, time: Array) -> Array:
        return np.asarray(0.5 - 0.5 * np.cos(np.pi * np.clip((time - self.delay) / self.rise, 0.0, 1.0)))


class Samples(Value):
    """Given values with linear interpolation; 0 after the last value."""

    kind: Literal["samples"] = "samples"
    dt: float = quantity("Time step of the samples", "s", gt=0, le=10)
    values: tuple[Share, ...] = quantity("Values as fractions of the amplitude", min_length=2, max_length=1_000_000)
    title: ClassVar[str] = "Written in the plan"

    @property
    def duration(self) -> float:
        return (len(self.values) - 1) * self.dt

    def sample(self, time: Array) -> Array:
        return np.interp(time, np.arange(len(self.values)) * self.dt, self.values, right=0.0)


Shape = Annotated[Still | Sine | Triangle | IncreasingCycles | Chirp | BandNoise | Step | Samples, Field(discriminator="kind")]
SHAPES = (Still, Sine, Triangle, IncreasingCycles, Chirp, BandNoise, Step, Samples)


def _tapered(time: Array, duration: float, rise: float) -> Array:
    """The envelope of a signal: 1 inside, half a cosine over `rise` at both ends, 0 outside."""
    inside = (time >= 0) & (time <= duration)
    if rise <= 0:
        return inside.astype(float)
    edge = np.clip(np.minimum(time, duration - time) / min(rise, duration / 2), 0.0, 1.0)
    return np.where(inside, 0.5 - 0.5 * np.cos(np.pi * edge), 0.0)
