"""The interface of a component: its data, its planned parts, their replay, and the effects that they can leave out."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
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
from rths_engine.planning.known import How, station_tolerance

# chosen; see docs/decisions/0023
REPLAY_RATE = 1024.0  # Hz


class Signal(NamedTuple):
    """A signal of a component with its label, its SI unit and values, and the unit shown on pages."""

    label: str
    unit: str
    shown: str
    values: Array


@dataclass(frozen=True)
class Data(ABC):
    """Recorded signals at the ends of a component, every `dt` (s) from `start` (s). Before `start` the component is at rest."""

    dt: float
    start: float
    stepped: bool  # recorded by this program's loop; a replay then takes the same steps

    @property
    @abstractmethod
    def raw(self) -> Array:
        """The recorded output (channels, samples) at the sampling rate of the recording."""

    @property
    def input_noise(self) -> float:
        """Standard deviation of the noise on the input; 0 where it is not known."""
        return 0.0

    def redrawn(self, random: np.random.Generator) -> Any:
        """The data with another draw of the noise on the input."""
        return self

    def thinned(self) -> Any:
        """The data with every second sample of the input left out and interpolated."""
        return self

    def behind(self) -> Any:
        """The data with the velocity of the input computed from the present and earlier samples only."""
        return self

    @property
    def pressed(self) -> float:
        """Force on a specimen before the start; 0 where it is not known."""
        return 0.0

    @property
    def warmth(self) -> Array | None:
        """Temperature (K) of a specimen, one value for each sample or one for all; None where it is not known."""
        return None

    @property
    def band(self) -> Band:
        return Band.of(self.dt)

    @property
    def step(self) -> float:
        return self.band.step

    @cached_property
    def measured(self) -> Array:
        """The recorded output (channels, n) in the band of the comparison."""
        return self.reduced(self.raw)

    @property
    def time(self) -> Array:
        return self.start + self.step * np.arange(self.measured.shape[1])

    @cached_property
    def step_error(self) -> Array | None:
        """The change (channels, n) that finer replay steps make to the output; None until `settle` has computed it."""
        return None

    def reduced(self, signals: Array) -> Array:
        return np.array([self.band.reduced(one) for one in signals])

    @property
    def finer(self) -> int:
        """Number of replay steps in a sample.

        The velocity of a part is a backward difference, which is half a step late. Measured signals do not come from
        such steps, so they are replayed in finer steps.
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
        """The times of the steps of `refined`, in samples."""
        n = self.finer * more
        found: Array = np.clip((np.arange(samples * n) + 0.25) / n, 0, samples - 1)
        return found


class Loose(Part):
    """A base part that the plan does not contain, whose parameters are fitted. `scale` is the unit of its parameters in z."""

    scale: ClassVar[float]

    def build(self, dt: float) -> tuple[Array, Array]:
        return np.zeros(1), np.zeros(1)


class State(NamedTuple):
    """Displacement and velocity at one place; `place` is empty where a component has only one."""

    place: str
    x: Signal
    v: Signal


class Feature(NamedTuple):
    """A term of a law, as a formula and in words, and the change `response` (channels, n) that it makes to the output.

    `sizes` are the values that scale the symbols of the formula. `unit` is the SI value of the coefficient 1: a force, or a
    displacement for an actuator. `place` is the storey of a structure.
    """

    formula: str
    words: str
    response: Array
    sizes: Any = None
    unit: float = 1.0
    place: str = ""


@dataclass(frozen=True)
class Component(ABC):
    """A component that is simulated alone. `base` are the planned parts; `spread` gives the tolerance of their parameters.

    `known` states how well the numbers of the plan are known, by path.
    """

    name: str
    base: tuple[Part, ...]
    known: Mapping[str, How] = field(default_factory=dict, kw_only=True)
    output: ClassVar[str]

    def spread(self, part: Part, field: str = "") -> float | None:
        """The tolerance of a planned parameter: its relative standard deviation, or None where it is free.

        `field` is the name of the parameter in the part. What the plan states about the number comes before the default.
        """
        return None

    @abstractmethod
    def predicted(self, parts: Sequence[Any], data: Any) -> Array:
        """The simulated output (channels, n) in the band of the comparison; `parts` are the base parts, then the effects."""

    def settle(self, parts: Sequence[Any], data: Sequence[Any]) -> None:
        """Compute and store the error of the replay steps of each data set; `parts` are nearly fitted."""
        return None

    @abstractmethod
    def hypotheses(self, data: Any) -> Iterator[Effect]:
        """All effects of the library that the component can leave out, each at its starting sizes."""

    @abstractmethod
    def features(self, parts: Sequence[Any], data: Any, like: Any = None) -> list[Feature]:
        """The terms of the general law, from which an unknown law is selected.

        The terms are scaled by the sizes of the recording `like`, or of `data` itself.
        """

    @abstractmethod
    def signals(self, data: Any) -> tuple[Signal, Signal]:
        """Displacement and velocity in the band of the comparison, against which the residual is described."""

    def states(self, data: Any) -> list[State]:
        """Displacement and velocity at each place where a law may act: a structure has an entry for each storey."""
        x, v = self.signals(data)
        return [State("", x, v)]

    def loaded(self, parts: Sequence[Any], data: Any, added: Sequence[Array]) -> Array:
        """The simulated output (channels, n) where `added` (n) acts at each of the `states`."""
        return np.asarray(self.predicted(parts, data) + np.asarray(added[0]))

    def seen(self, data: Any) -> list[Seen]:
        """The largest motions, forces and energies of the component; a structure has an entry for each storey."""
        return [data.seen()]

    def present(self, parts: Sequence[Part]) -> set[tuple[type[Part], int]]:
        """Keys of the effects that the model already contains, which need no hypothesis."""
        return {key(part) for part in parts if isinstance(part, Effect)}

    def stated(self, section: str, field: str = "") -> float | None:
        """The tolerance that the plan states for a section of the component's station, or for a field in it."""
        return station_tolerance(self.known, int(self.station or 1) - 1, section, field)

    @property
    def station(self) -> str:
        return self.name.partition(":")[2]

    def place(self, effect: Effect) -> str:
        """The component that a diagnosis names for an effect."""
        if isinstance(effect, Reading):
            return f"sensor:{effect.channel}.{self.station}"  # type: ignore[attr-defined]
        return self.name


def guessed(kinds: Iterable[type[Effect]], seen: Seen, lacking: Collection[str] = ()) -> Iterator[Effect]:
    """The effects of the kinds at their starting sizes, without effects that need one of the roles `lacking`."""
    for search in (physics.SEARCHES[kind] for kind in kinds):
        if not set(lacking) & set(search.needs):
            yield from search.guesses(seen)


def key(effect: Part) -> tuple[type[Part], int]:
    """The key of an effect: its type and its storey. Effects with the same key are one hypothesis."""
    return type(effect), int(getattr(effect, "storey", 0))
