"""The next test: the command that separates two models best within the limits of the rig."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, Literal

import numpy as np

from rths_engine.diagnosis.components import ActuatorData, SpecimenData
from rths_engine.diagnosis.fitting import Recordings
from rths_engine.diagnosis.parallel import each
from rths_engine.diagnosis.separate import APART
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import Part

# chosen; see docs/decisions/0023
CYCLES = 6
FREQUENCIES = (0.1, 0.25, 0.5, 1.0, 2.0)  # Hz
TRIANGLE = 0.05  # Hz
SHARES = (0.25, 0.5, 1.0, 1.5)  # of the largest displacement in the recording


@dataclass(frozen=True)
class Motion:
    """A command that a rig can make: its shape in words, amplitude (m), frequency (Hz), cycles and samples (m)."""

    waveform: Literal["sine", "triangle"]
    amplitude: float
    frequency: float
    cycles: int
    x: Array

    @property
    def signal(self) -> str:
        return f"a {self.waveform} of {1e3 * self.amplitude:.3g} mm at {self.frequency:g} Hz, {self.cycles} cycles"


@dataclass(frozen=True)
class NextTest:
    """A test and its expected lambda: the squared distance of the two simulations in units of the noise."""

    motion: Motion
    expected: float

    @property
    def signal(self) -> str:
        return self.motion.signal


def motions(data: ActuatorData | SpecimenData, stroke: float, speed: float) -> list[Motion]:
    """Sines and triangles within the rig's `stroke` (m) and `speed` (m/s), scaled by the largest recorded displacement."""
    largest = data.seen().x
    offers = []
    for share in SHARES:
        amplitude = min(share * largest, stroke)
        for frequency in FREQUENCIES:
            if 2 * np.pi * frequency * amplitude <= speed:
                offers.append(Motion("sine", amplitude, frequency, CYCLES, _sine(amplitude, frequency, data.dt)))
        if 4 * TRIANGLE * amplitude <= speed:
            offers.append(Motion("triangle", amplitude, TRIANGLE, 2, _triangle(amplitude, TRIANGLE, data.dt)))
    return offers


def next_test(
    recordings: Recordings, one: Sequence[Part], other: Sequence[Part], stroke: float, speed: float
) -> NextTest | None:
    """The test with the largest expected lambda between two models, or None where no test separates them.

    The tests are the `motions` of the rig. A test separates two models where its lambda is at least APART. None also where the
    component has no drive.
    """
    data = recordings.data[0]
    if not isinstance(data, ActuatorData | SpecimenData):
        return None
    offers = motions(data, stroke, speed)

    def expected(offer: Motion) -> float:
        moved = _moved_as(data, offer.x)
        first, second = (recordings.component.predicted(parts, moved) for parts in (one, other))
        apart = sum(
            float(np.sum(noise.whitened(a - b) ** 2)) for noise, a, b in zip(recordings.noises, first, second, strict=True)
        )
        return apart if np.isfinite(apart) else 0.0

    if not offers:
        return None
    reached = each(expected, offers)
    best = int(np.argmax(reached))
    if reached[best] < APART:
        return None
    return NextTest(offers[best], reached[best])


def _sine(amplitude: float, frequency: float, dt: float) -> Array:
    """CYCLES cycles of a sine whose amplitude rises over the first cycle."""
    time = np.arange(0.0, CYCLES / frequency, dt)
    rise: Array = np.minimum(1.0, time * frequency)
    return np.asarray(amplitude * rise * np.sin(2 * np.pi * frequency * time))


def _triangle(amplitude: float, frequency: float, dt: float) -> Array:
    """Two cycles of a triangle."""
    time = np.arange(0.0, 2 / frequency, dt)
    return np.asarray(amplitude * 2 / np.pi * np.arcsin(np.sin(2 * np.pi * frequency * time)))


def _moved_as(data: Any, x: Array) -> Any:
    """The data with the motion `x` (m) in place of the recorded motion."""
    if isinstance(data, SpecimenData):
        current, temperature = np.full(len(x), float(np.mean(data.current))), np.full(1, float(np.mean(data.temperature)))
        moved: Any = replace(data, x=x, force=x, current=current, temperature=temperature)
        moved.__dict__["smooth"] = x
        return moved
    return replace(data, command=x, x=x, force=None)
