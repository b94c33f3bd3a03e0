"""The next test: the command that separates two models best within the limits of the rig."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

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
class NextTest:
    """A test in words and its expected lambda: the squared distance of the two simulations in units of the noise."""

    signal: str
    expected: float


def next_test(
    recordings: Recordings, one: Sequence[Part], other: Sequence[Part], stroke: float, speed: float
) -> NextTest | None:
    """The test with the largest expected lambda between two models, or None where no test separates them.

    The tests are sines and triangles within the rig's `stroke` (m) and `speed` (m/s). A test separates two models where its
    lambda is at least APART. None also where the component has no drive.
    """
    data = recordings.data[0]
    if not isinstance(data, ActuatorData | SpecimenData):
        return None
    largest = data.seen().x
    offers = []
    for share in SHARES:
        for frequency in FREQUENCIES:
            amplitude = min(share * largest, stroke)
            if 2 * np.pi * frequency * amplitude <= speed:
                offers.append(
                    (
                        f"a sine of {1e3 * amplitude:.3g} mm at {frequency:g} Hz, {CYCLES} cycles",
                        _sine(amplitude, frequency, data.dt),
                    )
                )
        amplitude = min(share * largest, stroke)
        if 4 * TRIANGLE * amplitude <= speed:
            signal = _triangle(amplitude, TRIANGLE, data.dt)
            offers.append((f"a triangle of {1e3 * amplitude:.3g} mm at {TRIANGLE:g} Hz, 2 cycles", signal))

    def expected(offer: tuple[str, Array]) -> float:
        moved = _moved_as(data, offer[1])
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
    return NextTest(offers[best][0], reached[best])


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
