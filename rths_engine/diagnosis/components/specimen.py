"""A specimen: its input is the displacement, its output the force."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any, ClassVar

import numpy as np
from scipy.interpolate import CubicHermiteSpline, CubicSpline

from rths_engine.diagnosis.components.component import Component, Data, Feature, Loose, Signal, guessed
from rths_engine.diagnosis.components.features import Sizes, modulated, of_motion, of_position, shaped
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import Part, quantity
from rths_engine.parts import physics
from rths_engine.parts.physics.effect import Effect
from rths_engine.parts.physics.search import Seen, trend
from rths_engine.parts.physics.sensor.channel import OfForce
from rths_engine.planning.plan import ROOM
from rths_engine.recordings.excitation.smoother import Smoother
from rths_engine.running import replay

# chosen; see docs/decisions/0023
REACH, TAPER = 16, 6.0  # filter of a delay by a fraction of a sample: samples on each side, and beta of its window
FINER = 8  # finer steps in a replay step, which give the error of that step
AT_REST, SLIGHT = 0.1, 0.02  # s at the start; share of the largest force
SENSORS = tuple(kind for kind in physics.SENSOR if issubclass(kind, OfForce))


@dataclass(frozen=True)
class SpecimenData(Data):
    """Signals of a specimen: measured displacement (m), force (N), current (A) and temperature (K).

    `expected` (m) is the displacement that the fitted actuator makes of its command, or None where it is not known. It supplies
    the motion that noise hides in the reading, such as ripples of a command.
    """

    x: Array
    force: Array
    current: Array
    expected: Array | None = None
    temperature: Array = field(default_factory=lambda: np.full(1, ROOM))

    @property
    def raw(self) -> Array:
        return self.force[None]

    @property
    def warmth(self) -> Array:
        return self.temperature

    @cached_property
    def smoother(self) -> Smoother:
        return Smoother.of(self.x - self._known, self.dt)

    @cached_property
    def smooth(self) -> Array:
        return self._known + self.smoother.smoothed(self.x - self._known)

    @property
    def _known(self) -> Array | float:
        return 0.0 if self.expected is None else self.expected

    @property
    def input_noise(self) -> float:
        return self.smoother.noise

    def redrawn(self, random: np.random.Generator) -> SpecimenData:
        drawn = replace(self)
        drawn.__dict__["smooth"] = self.smooth + self.smoother.error(len(self.x), random)
        drawn.__dict__["step_error"] = self.step_error
        return drawn

    def thinned(self) -> SpecimenData:
        place = np.arange(len(self.x))
        thin = replace(self)
        thin.__dict__["smooth"] = CubicSpline(place[::2], self.smooth[::2])(np.minimum(place, place[::2][-1]))
        thin.__dict__["step_error"] = self.step_error
        return thin

    def behind(self) -> SpecimenData:
        """The data with a motion of Hermite cubics whose slopes come from the present and the two earlier samples.

        A controller that moves the specimen in steps makes such a motion.
        """
        if self.expected is None or self.stepped:
            return self
        place = np.arange(len(self.x))
        x = np.concatenate([np.full(2, self.smooth[0]), self.smooth])
        slopes = 1.5 * x[2:] - 2 * x[1:-1] + 0.5 * x[:-2]
        late = replace(self)
        late.__dict__["fine"] = CubicHermiteSpline(place, self.smooth, slopes)(self.places(len(place)))
        late.__dict__["step_error"] = self.step_error
        return late

    @cached_property
    def fine(self) -> Array:
        """The smoothed displacement (m) at the steps of the replay."""
        return self.refined(self.smooth)

    @cached_property
    def kept(self) -> replay.KeptForces:
        """Forces of specimens without effects under the displacement `fine`."""
        return replay.KeptForces()

    @cached_property
    def pressed(self) -> float:
        """Mean force at the start (N); 0 where it may be noise."""
        begun = self.force[: max(1, round(AT_REST / self.dt))]
        force = float(np.mean(begun))
        return force if abs(force) > max(3 * float(np.std(begun)), SLIGHT * float(np.max(np.abs(self.force)))) else 0.0

    @cached_property
    def velocity(self) -> Array:
        return np.gradient(self.smooth, self.dt)

    @cached_property
    def sizes(self) -> Sizes:
        return Sizes.of(self.smooth, self.velocity, self.dt, self.force)

    @cached_property
    def features(self) -> list[Feature]:
        """The terms of the general law that depend on the recording alone."""
        return self.features_in(self.sizes)

    def features_in(self, sizes: Sizes) -> list[Feature]:
        terms = of_motion(self.smooth, self.velocity, self.dt, self.force, sizes)
        return shaped(terms + of_position(self.smooth, self.velocity, self.dt, sizes), self, sizes)

    def seen(self) -> Seen:
        energy = float(np.sum(np.abs(self.force * self.velocity)) * self.dt)
        x, v, f = (float(np.max(np.abs(one))) for one in (self.smooth, self.velocity, self.force))
        current, temperature = float(np.max(np.abs(self.current))), float(np.mean(self.temperature))
        time, shape = len(self.x) * self.dt, trend(self.smooth)
        return Seen(x, v, f, time, energy, self.dt, trend=shape, current=current, temperature=temperature)


class ClockSkew(Loose):
    """Delay of the force channel relative to the displacement channel, within one recorder."""

    delay: float = quantity("Delay between the channels", "s", "ms", ge=-0.01, le=0.01, default=0.0)
    scale: ClassVar[float] = 1e-3


class StepError(Loose):
    """Error of the replay steps, in units of the change that FINER times finer steps make."""

    share: float = quantity("Error of the replay's steps", ge=0, le=2, default=FINER / (FINER - 1))
    scale: ClassVar[float] = 1.0


# chosen; see docs/decisions/0023
SPREADS: dict[type[Part], float] = {ClockSkew: 0.25, StepError: 0.25}  # ms; of the difference


def loose_spread(component: Component, part: Loose) -> float | None:
    """The tolerance of a nuisance parameter of a force: the clock skew or the step error."""
    stated = component.stated("clock") if isinstance(part, ClockSkew) else None
    return SPREADS.get(type(part)) if stated is None else stated


@dataclass(frozen=True)
class Specimen(Component):
    """The specimen of a station: displacement -> force.

    The base is the specimen with the effects of its plan. For a measured recording, it also has a clock skew and a step error.
    """

    output: ClassVar[str] = "force"

    def spread(self, part: Part, field: str = "") -> float | None:
        if isinstance(part, Loose):
            return loose_spread(self, part)
        return self.stated("specimen", "" if isinstance(part, Effect) else field)

    def predicted(self, parts: Sequence[Any], data: SpecimenData) -> Array:
        return pressed(parts, data.fine, data.current, data)

    def force(self, parts: Sequence[Any], data: SpecimenData) -> Array:
        """The force (N) at the step of the recording."""
        n = data.finer
        return _force(parts, data.fine, np.repeat(data.current, n), data.dt / n, data)[::n]

    def settle(self, parts: Sequence[Any], data: Sequence[SpecimenData]) -> None:
        for one in data:
            settled(parts, one.smooth, one.current, one)

    def hypotheses(self, data: SpecimenData) -> Iterator[Effect]:
        given = {"current": data.current, "temperature": data.temperature}
        steady = [role for role, values in given.items() if not np.ptp(values) > 0]
        yield from guessed((*physics.SPECIMEN, *SENSORS), data.seen(), lacking=steady)

    def features(self, parts: Sequence[Any], data: SpecimenData, like: Any = None) -> list[Feature]:
        sizes = data.sizes if like is None else like.sizes
        terms = data.features if sizes is data.sizes else data.features_in(sizes)
        return terms + modulated(self.predicted(parts, data) / sizes.f, "f", "a strength", sizes)

    def signals(self, data: SpecimenData) -> tuple[Signal, Signal]:
        x, v = data.reduced(np.array([data.smooth, data.velocity]))
        return Signal("displacement", "m", "mm", x), Signal("velocity", "m/s", "mm/s", v)


def pressed(parts: Sequence[Any], fine: Array, current: Array, data: Data) -> Array:
    """Force (1, n) of the specimen in the band of the comparison for the displacement `fine` (m) at the steps of the replay.

    `parts` are the specimen, then the effects, the clock skew and the step error.
    """
    n = data.finer
    force = _force(parts, fine, np.repeat(current, n), data.dt / n, data)
    found = _late(data.reduced(force[None, ::n]), sum(part.delay for part in parts if isinstance(part, ClockSkew)) / data.step)
    share = sum(part.share for part in parts if isinstance(part, StepError))
    return found if data.step_error is None else found + share * data.step_error


def _late(signals: Array, samples: float) -> Array:
    """Signals (channels, n) delayed by a few samples, by a sinc filter with a Kaiser window.

    The response to a jump at the start ends within the window, REACH samples.
    """
    if not samples:
        return signals
    after = np.arange(-REACH, REACH + 1) - samples
    taps = np.sinc(after) * np.i0(TAPER * np.sqrt(np.clip(1 - (after / REACH) ** 2, 0, None))) / np.i0(TAPER)
    return np.array([np.convolve(_continued(one), taps, "valid") for one in signals])


def _continued(signal: Array) -> Array:
    """The signal continued at both ends by REACH samples, turned about its first and its last value."""
    before, after = 2 * signal[0] - signal[REACH:0:-1], 2 * signal[-1] - signal[-2 : -2 - REACH : -1]
    return np.concatenate([before, signal, after])


def settled(parts: Sequence[Any], x: Array, current: Array, data: Data) -> None:
    """Compute the step error of the data from finer steps and store it in the data."""
    if data.stepped:
        return
    n = data.finer
    whole = _force(parts, data.refined(x), np.repeat(current, n), data.dt / n, data)[::n]
    n *= FINER
    finest = _force(parts, data.refined(x, FINER), np.repeat(current, n), data.dt / n, data)[::n]
    data.__dict__["step_error"] = data.reduced((finest - whole)[None])


def _force(parts: Sequence[Any], x: Array, current: Array, dt: float, data: Data) -> Array:
    effects = [part for part in parts[1:] if isinstance(part, Effect)]
    kept = data.kept if isinstance(data, SpecimenData) and x is data.fine else None
    warmth = data.warmth
    if warmth is not None and len(warmth) > 1:
        warmth = np.repeat(warmth, len(x) // len(warmth))
    return replay.specimen(parts[0], effects, x, current, dt, data.start, data.pressed, kept, warmth)
