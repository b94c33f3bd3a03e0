"""One component of a test with what was recorded at its ends."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from rths_engine import physics, replay
from rths_engine.arrays import Array
from rths_engine.diagnosis.band import Band, cut_of, filtered
from rths_engine.part import Part
from rths_engine.physics.effect import Effect, Seen


@dataclass(frozen=True)
class SpecimenData:
    """Displacement in, force out, every dt (s), at rest before the first sample."""

    x: Array
    force: Array
    current: Array
    dt: float
    smooth: Array = field(init=False)
    x_noise: float = field(init=False)
    cut: float | None = field(init=False)

    def __post_init__(self) -> None:
        cut = cut_of(self.x, self.dt)
        smooth = filtered(self.x, self.dt, cut)
        object.__setattr__(self, "cut", cut)
        object.__setattr__(self, "smooth", smooth)
        object.__setattr__(self, "x_noise", float(np.std(self.x - smooth)))

    def noisy(self, random: np.random.Generator) -> Array:
        """The smoothed displacement of another recording with as much noise."""
        return self.smooth + filtered(self.x_noise * random.standard_normal(len(self.x)), self.dt, self.cut)

    @property
    def band(self) -> Band:
        return Band.of(self.dt)

    def seen(self) -> Seen:
        v = np.gradient(self.smooth, self.dt)
        energy = float(np.sum(np.abs(self.force * v)) * self.dt)
        x, v, f = (float(np.max(np.abs(one))) for one in (self.smooth, v, self.force))
        return Seen(x, v, f, len(self.x) * self.dt, energy, self.dt)


@dataclass(frozen=True)
class Specimen:
    """Displacement -> force of a station's specimen."""

    name: str
    baseline: Part
    known: tuple[Effect, ...] = ()
    catalogue: tuple[type[Effect], ...] = physics.SPECIMEN

    def predicted(self, parts: Sequence[Any], data: SpecimenData, x: Array | None = None) -> Array:
        """The simulated force (N) in the band of the comparison, of the baseline parts[0] with the effects that follow."""
        effects = [*self.known, *parts[1:]]
        force = replay.specimen(parts[0], effects, data.smooth if x is None else x, data.current, data.dt)
        return data.band.reduced(force)

    def measured(self, data: SpecimenData) -> Array:
        return data.band.reduced(data.force)
