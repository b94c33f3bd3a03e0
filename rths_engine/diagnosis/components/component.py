"""What every component offers to the diagnosis: its models, their replay, and the effects it may leave out."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, ClassVar, NamedTuple

import numpy as np
from scipy.interpolate import CubicSpline

from rths_engine.diagnosis.band import Band
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import Part
from rths_engine.parts import physics
from rths_engine.parts.physics.effect import Effect
from rths_engine.parts.physics.search import Seen
from rths_engine.parts.physics.sensor.channel import Reading

# chosen; see docs/decisions/0023
REPLAY_RATE = 1024.0  # Hz


class Signal(NamedTuple):
    """A signal of a component as people read it: SI values and the unit shown."""

    label: str
    unit: str
    shown: str
    values: Array


@dataclass(frozen=True)
class Data(ABC):
    """Signals at the ends of a component every dt (s) from `start` (s), at rest before."""

    dt: float
    start: float
    stepped: bool  # recorded by the loop of this program, whose steps a replay takes too

    @property
    @abstractmethod
    def raw(self) -> Array:
        """(channels, samples) of the output at the rate of the recording."""

    @property
    def input_noise(self) -> float:
        """Standard deviation of the noise that enters with the input; 0 where none is known."""
        return 0.0

    def redrawn(self, random: np.random.Generator) -> Any:
        """As if recorded again: other noise of the same size on the input."""
        return self

    def thinned(self) -> Any:
        """As if every second sample of the input had not been recorded."""
        return self

    def behind(self) -> Any:
        """As if the velocity of the input were told by the samples up to its own."""
        return self

    @property
    def pressed(self) -> float:
        """Force on a specimen before the start; 0 where none is known."""
        return 0.0

    @property
    def band(self) -> Band:
        return Band.of(self.dt)

    @property
    def step(self) -> float:
        return self.band.step

    @cached_property
    def measured(self) -> Array:
        """(channels, n) of the output in the band of the comparison."""
        return self.reduced(self.raw)

    @property
    def time(self) -> Array:
        return self.start + self.step * np.arange(self.measured.shape[1])

    @cached_property
    def step_error(self) -> Array | None:
        """(channels, n) of what much finer steps do to the output; None until it is found."""
        return None

    def reduced(self, signals: Array) -> Array:
        return np.array([self.band.reduced(one) for one in signals])

    @property
    def finer(self) -> int:
        """Number of replay steps in a sample.

        A part's velocity is a backward difference, half a step late. Signals that were measured, and did not come from such
        steps, are replayed in finer steps.
        """
        return 1 if self.stepped else max(1, int(np.ceil(REPLAY_RATE * self.dt - 1e-9)))

    def refined(self, signal: Array, more: int = 1) -> Array:
        """Resample a signal to the replay's steps, or `more` times as fine, a quarter of a step early.

        A quarter of a step is midway between what velocity and displacement need.
        """
        if self.stepped:
            return signal
        return np.asarray(CubicSpline(np.arange(len(signal)), signal)(self.places(len(signal), more)))

    def places(self, samples: int, more: int = 1) -> Array:
        """Of the steps of `refined`, in samples."""
        n = self.finer * more
        found: Array = np.clip((np.arange(samples * n) + 0.25) / n, 0, samples - 1)
        return found


class Loose(Part):
    """A base part that is not of the plan, and moves."""

    scale: ClassVar[float]

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.zeros(1), np.zeros(1)


class Feature(NamedTuple):
    """A term of a law of the output, told by its formula and in words, and what it does to the output (channels, n)."""

    formula: str
    words: str
    response: Array


@dataclass(frozen=True)
class Component(ABC):
    """`base` are the planned parts, whose numbers move by `tolerance`: standard deviations by kind, None where free."""

    name: str
    base: tuple[Part, ...]
    output: ClassVar[str]

    def spread(self, part: Part) -> float | None:
        """How far, as a share, a planned number may be off; None: as far as it likes."""
        return None

    @abstractmethod
    def predicted(self, parts: Sequence[Any], data: Any) -> Array:
        """(channels, n) of the output in the band of the comparison, of the base parts and the effects that follow."""

    def settle(self, parts: Sequence[Any], data: Sequence[Any]) -> None:
        """Find what the replay's steps do to the output, once the parts are nearly fitted."""
        return None

    @abstractmethod
    def hypotheses(self, data: Any) -> Iterator[Effect]:
        """Every effect of the library at its guesses."""

    @abstractmethod
    def features(self, parts: Sequence[Any], data: Any) -> list[Feature]:
        """Terms of which an unknown law may consist."""

    @abstractmethod
    def signals(self, data: Any) -> tuple[Signal, Signal]:
        """Displacement and velocity, in the band of the comparison, that the output is told against."""

    def seen(self, data: Any) -> list[Seen]:
        """Sizes of what the component went through, of each of its storeys."""
        return [data.seen()]

    def present(self, parts: Sequence[Part]) -> set[tuple[type[Part], int]]:
        """Keys of the effects that need no hypothesis, since the model has them."""
        return {key(part) for part in parts if isinstance(part, Effect)}

    @property
    def station(self) -> str:
        return self.name.partition(":")[2]

    def place(self, effect: Effect) -> str:
        """The component that a diagnosis names for an effect."""
        if isinstance(effect, Reading):
            return f"sensor:{effect.channel}.{self.station}"  # type: ignore[attr-defined]
        return self.name


def guessed(kinds: Iterable[type[Effect]], seen: Seen, lacking: str = "") -> Iterator[Effect]:
    """Every effect of the kinds at its guesses, but for those that need the role `lacking`."""
    for search in (physics.SEARCHES[kind] for kind in kinds):
        if lacking not in search.needs:
            yield from search.guesses(seen)


def key(effect: Part) -> tuple[type[Part], int]:
    """Effects of one key are one hypothesis."""
    return type(effect), int(getattr(effect, "storey", 0))
