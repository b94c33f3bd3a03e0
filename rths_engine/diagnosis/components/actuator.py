"""An actuator: its input is the command and its output the measured displacement, against a measured force if there is one."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, ClassVar

import numpy as np
from scipy.signal import detrend

from rths_engine.diagnosis.components.component import Component, Data, Feature, Signal, guessed
from rths_engine.diagnosis.components.features import Sizes, modulated, of_motion, of_position, shaped
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import Part
from rths_engine.parts import physics
from rths_engine.parts.physics.effect import Effect
from rths_engine.parts.physics.search import Seen
from rths_engine.parts.physics.sensor.channel import OfDisplacement
from rths_engine.running import replay

# chosen; see docs/decisions/0023
SENSORS = tuple(kind for kind in physics.SENSOR if issubclass(kind, OfDisplacement))
TOLERANCE = 0.05


@dataclass(frozen=True)
class ActuatorData(Data):
    """Signals of an actuator: command (m), measured displacement (m) and force on the actuator (N).

    The force is None where it was not measured. `wanders` is true for a drive in open loop: its displacement has an arbitrary
    origin and drifts, so the origin and the slope are removed from the comparison.
    """

    command: Array
    x: Array
    force: Array | None
    wanders: bool = False

    @property
    def raw(self) -> Array:
        return self.x[None]

    def reduced(self, signals: Array) -> Array:
        found = super().reduced(signals)
        return detrend(found) if self.wanders else found

    @cached_property
    def load(self) -> Array:
        return np.zeros(len(self.command)) if self.force is None else self.force

    @cached_property
    def velocity(self) -> Array:
        return np.gradient(self.command, self.dt)

    @cached_property
    def sizes(self) -> Sizes:
        return Sizes.of(self.command, self.velocity, self.dt, self.velocity if self.force is None else self.force)

    @cached_property
    def features(self) -> list[Feature]:
        """The terms of the general law."""
        return self.features_in(self.sizes)

    def features_in(self, sizes: Sizes) -> list[Feature]:
        load = self.velocity if self.force is None else self.force
        terms = of_motion(self.command, self.velocity, self.dt, load, sizes)
        if self.force is not None:
            load = self.force / sizes.f
            terms += [
                ("f", "proportional to the force on the actuator", load),
                ("f |f|", "growing with the square of the force on the actuator", load * np.abs(load)),
            ]
        terms += of_position(self.command, self.velocity, self.dt, sizes)
        lag = self.reduced(self.velocity[None] / sizes.v)
        return shaped(terms, self, sizes) + modulated(lag, "v", "a lag", sizes)

    def seen(self) -> Seen:
        load = float(np.max(np.abs(self.load)))
        energy = float(np.sum(np.abs(self.load * self.velocity)) * self.dt)
        moved = self.band.reduced(self.x)  # a command may be a voltage
        x = min(float(np.max(np.abs(one))) for one in (self.command, moved))
        v = min(float(np.max(np.abs(one))) for one in (self.velocity, np.gradient(moved, self.step)))
        return Seen(x, v, load, len(self.x) * self.dt, energy, self.dt)


@dataclass(frozen=True)
class Actuator(Component):
    """Compensated command -> measured displacement of an actuator. The base is the actuator with its planned effects."""

    output: ClassVar[str] = "displacement"

    def spread(self, part: Part, field: str = "") -> float | None:
        stated = self.stated("actuator", "" if isinstance(part, Effect) else field)
        return TOLERANCE if stated is None else stated

    def predicted(self, parts: Sequence[Any], data: ActuatorData) -> Array:
        return data.reduced(self.moved(parts, data)[None])

    def moved(self, parts: Sequence[Any], data: ActuatorData) -> Array:
        """The displacement that the sensor reads (m), at the step of the recording."""
        return replay.actuator(parts[0], parts[1:], data.command, data.load, data.dt, data.start)

    def hypotheses(self, data: ActuatorData) -> Iterator[Effect]:
        yield from guessed((*physics.ACTUATOR, *SENSORS), data.seen(), lacking=("f_meas",) if data.force is None else ())

    def features(self, parts: Sequence[Any], data: ActuatorData, like: Any = None) -> list[Feature]:
        return data.features if like is None or like is data else data.features_in(like.sizes)

    def signals(self, data: ActuatorData) -> tuple[Signal, Signal]:
        x, v = data.reduced(np.array([data.command, data.velocity]))
        return Signal("command", "m", "mm", x), Signal("velocity of the command", "m/s", "mm/s", v)
