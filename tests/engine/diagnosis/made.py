"""A component whose output is linear in its numbers: its fits, intervals, signatures and probabilities have closed forms.

Output = gain * (drive) + sum of size_k * wave_k(t), with `wave_k` the k-th shape of `SHAPES`, one sample every DT.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar, Literal

import numpy as np

from rths_engine.diagnosis.claims import Claims
from rths_engine.diagnosis.components.component import Component, Data, Feature, Signal
from rths_engine.diagnosis.fitting import Fitted, Recordings
from rths_engine.diagnosis.judge import Judged
from rths_engine.diagnosis.noise import Noise
from rths_engine.diagnosis.select import Selection
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import Part, quantity
from rths_engine.parts import physics
from rths_engine.parts.physics.effect import FORCE, Effect
from rths_engine.parts.physics.search import Search, Seen

DT = 0.01  # s: 100 Hz is below the rate of the analysis, so that the band passes the signals unchanged
SAMPLES = 600
SIGMA = 0.1


def drive(count: int = SAMPLES) -> Array:
    """Three sines without a common period in the recording."""
    time = DT * np.arange(count)
    return np.asarray(np.sin(2 * np.pi * 0.7 * time) + 0.5 * np.sin(2 * np.pi * 1.9 * time + 1) + 0.3 * np.cos(7.3 * time))


Shape = Callable[[Array], Array]
SHAPES: tuple[Shape, ...] = (
    lambda x: x**3,
    lambda x: np.abs(x),
    lambda x: np.gradient(x, DT) / 8,
    lambda x: np.tanh(8 * np.gradient(x, DT)),
)


class Gain(Part):
    """The planned part: output = gain * drive."""

    kind: Literal["gain"] = "gain"
    gain: float = quantity("Gain", default=2.0)
    title: ClassVar[str] = "Gain"

    def output(self, x: Array) -> Array:
        return self.gain * x


class Wave(Effect):
    """A left-out effect: output + size * SHAPES[storey - 1](drive), nested at size = 0."""

    kind: Literal["wave"] = "wave"
    size: float = quantity("Size", default=0.0, ge=-1e3, le=1e3)
    storey: int = 1
    title: ClassVar[str] = "Wave"
    hook: ClassVar[int] = FORCE
    neutral: ClassVar = {"size": 0.0}

    @property
    def id(self) -> str:
        return f"wave_{self.storey}"

    def output(self, x: Array) -> Array:
        return self.size * SHAPES[self.storey - 1](x)


class WaveSearch(Search[Wave]):
    """In each place on its own."""

    needs = ("x_meas", "f_meas")
    noun = "a wave"

    def guesses(self, seen: Seen) -> Iterator[Wave]:
        yield Wave(size=0.3, storey=seen.storey)

    def says(self, effect: Wave) -> str:
        return f"adds a wave of {effect.size:.3g}"


physics.SEARCHES[Wave] = WaveSearch(Wave)


@dataclass(frozen=True)
class Driven(Data):
    """The drive and what was measured."""

    x: Array
    out: Array

    @property
    def raw(self) -> Array:
        return self.out[None]

    def seen(self) -> Seen:
        return Seen(float(np.max(np.abs(self.x))), 10.0, float(np.max(np.abs(self.out))), 1.0, 1.0, self.dt)


@dataclass(frozen=True)
class Linear(Component):
    """The sum of its parts' outputs. `spreads` is how far the gain may be off its plan; `waves` are the hypotheses."""

    output: ClassVar[str] = "force"
    share: float | None = None
    waves: int = len(SHAPES)

    def spread(self, part: Part, field: str = "") -> float | None:
        return self.share

    def predicted(self, parts: Sequence[Any], data: Driven) -> Array:
        return np.array([sum((part.output(data.x) for part in parts), np.zeros(len(data.x)))])

    def hypotheses(self, data: Driven) -> Iterator[Effect]:
        for place in range(self.waves):
            yield Wave(size=0.3, storey=place + 1)

    def features(self, parts: Sequence[Any], data: Driven, like: Any = None) -> list[Feature]:
        x = data.x / np.max(np.abs((like or data).x))
        laws = (("x^2", x**2), ("x^3", x**3), ("x^5", x**5), ("x", x))
        return [Feature(formula, f"the law {formula}", values[None]) for formula, values in laws]

    def signals(self, data: Driven) -> tuple[Signal, Signal]:
        v = np.gradient(data.x, data.dt)
        return Signal("displacement", "m", "mm", data.x), Signal("velocity", "m/s", "mm/s", v)

    def seen(self, data: Driven) -> list[Seen]:
        return [data.seen()._replace(storey=place + 1) for place in range(len(SHAPES))]


def linear(gain: float = 2.0, share: float | None = None, waves: int = len(SHAPES)) -> Linear:
    return Linear("specimen:1", (Gain(gain=gain),), share, waves)


def driven(out: Array, x: Array | None = None) -> Driven:
    return Driven(DT, 0.0, True, drive(len(out)) if x is None else x, out)


def recordings(component: Component, *data: Any, sigma: float = SIGMA) -> Recordings:
    """Every sample fitted, each of the same weight, under white noise of a known deviation."""
    masks = tuple(np.ones(one.measured.shape[1], bool) for one in data)
    weights = tuple(np.ones(one.measured.shape) for one in data)
    noises = tuple(Noise.white(sigma) for _ in data[0].measured)
    return Recordings(component, tuple(data), masks, noises, weights, weights)


def noisy(parts: Sequence[Any], seed: int, count: int = SAMPLES, sigma: float = SIGMA) -> Driven:
    """A recording of the parts with white noise."""
    x = drive(count)
    clean = sum((part.output(x) for part in parts), np.zeros(count))
    return driven(clean + sigma * np.random.default_rng(seed).standard_normal(count), x)


def selected(used: Recordings, baseline: Fitted, chosen: Fitted, **more: Any) -> Selection:
    """A selection of the chosen model, as far as what follows looks at it."""
    given: dict[str, Any] = {"tried": (chosen,), "chances": (1.0,), "detections": (), "ranges": ()}
    return Selection(used, baseline, chosen, **(given | more))


def as_judged(
    selection: Selection,
    verdict: Any = "mismatch",
    unknown: bool = False,
    heldout: tuple[Any, ...] = (),
    proof: Claims | None = None,
) -> Judged:
    return Judged(selection.recordings.component, "specimen of station 1", selection, verdict, unknown, heldout, proof)
