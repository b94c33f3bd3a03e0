"""Actuator and specimen together, where the displacement between them was not measured."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from rths_engine.diagnosis.components.actuator import TOLERANCE, ActuatorData
from rths_engine.diagnosis.components.component import Component, Feature, Loose, Signal, guessed
from rths_engine.diagnosis.components.features import of_motion, of_position, shaped
from rths_engine.diagnosis.components.specimen import SENSORS, loose_spread, pressed, settled
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import Part
from rths_engine.parts import physics
from rths_engine.parts.physics.effect import Effect
from rths_engine.running import replay


@dataclass(frozen=True)
class ChainData(ActuatorData):
    """Signals of a chain: command (m) and force (N). `x` is also the command, because the displacement was not measured.

    `current` (A) is the current of the specimen, one value for each sample.
    """

    current: Array | None = None

    @property
    def raw(self) -> Any:
        return self.load[None]


@dataclass(frozen=True)
class Chain(Component):
    """Compensated command -> force. The base is actuator and specimen with the effects of the plan."""

    output: ClassVar[str] = "force"

    def spread(self, part: Part, field: str = "") -> float | None:
        if isinstance(part, Loose):
            return loose_spread(self, part)
        moving = part in self.base[:1] or isinstance(part, physics.ACTUATOR)
        stated = self.stated("actuator" if moving else "specimen", "" if isinstance(part, Effect) else field)
        return TOLERANCE if stated is None and part in self.base[:1] else stated

    def predicted(self, parts: Sequence[Any], data: ChainData) -> Any:
        resisting, x, current = _between(parts, data)
        return pressed(resisting, data.refined(x), current, data)

    def settle(self, parts: Sequence[Any], data: Sequence[ChainData]) -> None:
        for one in data:
            settled(*_between(parts, one), one)

    def hypotheses(self, data: ChainData) -> Iterator[Effect]:
        yield from guessed((*physics.ACTUATOR, *physics.SPECIMEN, *SENSORS), data.seen(), lacking=("current", "temperature"))

    def features(self, parts: Sequence[Any], data: ChainData, like: Any = None) -> list[Feature]:
        sizes = (data if like is None else like).sizes
        terms = of_motion(data.command, data.velocity, data.dt, data.load, sizes)
        return shaped(terms + of_position(data.command, data.velocity, data.dt, sizes), data, sizes)

    def signals(self, data: ChainData) -> tuple[Signal, Signal]:
        x, v = data.reduced(np.array([data.command, data.velocity]))
        return Signal("command", "m", "mm", x), Signal("velocity of the command", "m/s", "mm/s", v)

    def place(self, effect: Effect) -> str:
        named = super().place(effect)
        return f"actuator:{self.station}" if isinstance(effect, physics.ACTUATOR) else named


def _between(parts: Sequence[Any], data: ChainData) -> tuple[list[Any], Array, Array]:
    """The specimen with its effects, the displacement between actuator and specimen, and the current."""
    effects = parts[2:]
    moving = [effect for effect in effects if isinstance(effect, physics.ACTUATOR)]
    resisting = [parts[1], *(effect for effect in effects if not isinstance(effect, physics.ACTUATOR))]
    x = replay.actuator(parts[0], moving, data.command, data.load, data.dt, data.start)
    return resisting, x, np.ones(len(x)) if data.current is None else data.current
