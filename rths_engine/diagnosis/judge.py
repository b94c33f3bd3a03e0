"""The verdict on one component."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from scipy.stats import chi2

from rths_engine.diagnosis.components import Component
from rths_engine.diagnosis.fitting import Fitted, Recordings
from rths_engine.diagnosis.noise import Noise
from rths_engine.diagnosis.schema import Kind
from rths_engine.diagnosis.select import Selection, select
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import Part

# chosen; see docs/decisions/0023
BLOCKS, HELD_OUT = 10, (2, 5, 8)  # of a recording's blocks in a row, never fitted where no other recording is held out
ENDS = 0.3  # s at either end, which the filters blur
PLAIN = 25.0  # squared length in units of the noise: an unknown law so large is no chance
NOT_WHOLE = 1 / 3  # of what is beyond the planned model: a named effect that leaves more is not what was left out,
MOST = 0.1  # unless no more of the power of the error on what was not fitted is left
MORE_THAN_HALF, DOUBTFUL = 0.5, 0.05  # likewise, where what is left is no more than this probable by chance


@dataclass(frozen=True)
class Judged:
    """One component: what was selected, its verdict, and the recordings that were not fitted."""

    component: Component
    name: str
    selection: Selection
    verdict: Kind
    unknown: bool
    heldout: tuple[Any, ...]

    @property
    def recordings(self) -> Recordings:
        return self.selection.recordings

    @property
    def effects(self) -> tuple[Part, ...]:
        return () if self.unknown else self.selection.effects

    @property
    def gain(self) -> float:
        """Of chi^2 over the planned parts refitted, by the effects and by what a general law adds."""
        return self.selection.baseline.squared - self.selection.chosen.squared + self.left

    @property
    def left(self) -> float:
        """Squared length, in units of the noise, of what a general law could still explain."""
        last = self.selection.detections[-1]
        return max(0.0, last.explained - last.expected)

    @cached_property
    def unproved(self) -> float:
        """Share of the power of the error on what was not fitted that the effects leave."""
        before, after = (self.nrmse(one.parts, False) for one in (self.selection.baseline, self.selection.chosen))
        return after**2 / max(before**2, 1e-300)

    def remains(self, level: float) -> bool:
        """Whether a general law says that what was left out is another than the effects."""
        chance = self.selection.detections[-1].p_general
        return self.left > PLAIN and (
            (chance <= level and self.left > NOT_WHOLE * self.gain)
            or (chance <= DOUBTFUL and self.left > MORE_THAN_HALF * self.gain)
        )

    def nrmse(self, parts: Sequence[Part], fitted: bool | None) -> float:
        """RMS error over the RMS about the mean of the measured channels: fitted, held out, or all (None).

        Channels count alike. Infinite where the simulation runs away.
        """
        rows: list[tuple[Array, Array]] = []
        if fitted is False and self.heldout:
            for other in self.heldout:
                used = inner(other.measured.shape[1], other.step)
                rows.append((other.measured[:, used], self.component.predicted(parts, other)[:, used]))
        else:
            for one, mask in zip(self.recordings.data, self.recordings.masks, strict=True):
                inside = inner(len(mask), one.step)
                used = inside if fitted is None else mask if fitted else inside & ~mask
                rows.append((one.measured[:, used], self.component.predicted(parts, one)[:, used]))
        real, ours = (np.concatenate(one, axis=1) for one in zip(*rows, strict=True))
        spread = np.maximum(np.var(real, axis=1), 1e-300)
        return unbounded(float(np.sqrt(np.mean(np.mean((real - ours) ** 2, axis=1) / spread))))

    @property
    def noise(self) -> float:
        """Of the noise, likewise."""
        real = np.concatenate([one.measured for one in self.recordings.data], axis=1)
        shares = [
            noise.deviation**2 / max(float(np.var(row)), 1e-300)
            for noise, row in zip(self.recordings.noises, real, strict=True)
        ]
        return unbounded(float(np.sqrt(np.mean(shares))))


def judged(
    component: Component,
    name: str,
    data: Sequence[Any],
    heldout: Sequence[Any],
    level: float,
    random: np.random.Generator,
    told: Callable[[float], None],
) -> Judged:
    """Fit one component, detect and select what it leaves out, and judge it."""
    used = inner if heldout else fitted_blocks
    masks = tuple(used(one.measured.shape[1], one.step) for one in data)
    noises = tuple(Noise.white(1.0) for _ in data[0].measured)
    weights = tuple(np.ones(one.measured.shape) for one in data)
    selection = select(Recordings(component, tuple(data), masks, noises, weights, weights), level, random, told)
    component.settle(selection.chosen.parts, heldout)
    first = selection.detections[0]
    found = Judged(component, name, selection, "consistent", False, tuple(heldout))
    if first.p_value > level:
        return Judged(component, name, selection, _calibration(selection, level), False, found.heldout)
    remains = found.remains(level)
    if selection.effects and (not remains or found.unproved <= MOST):
        return Judged(component, name, selection, "mismatch", False, found.heldout)
    return Judged(component, name, selection, "mismatch" if remains else "undetermined", remains, found.heldout)


def fitted_blocks(count: int, step: float) -> Any:
    """True where fitted."""
    return inner(count, step) & ~np.isin(np.arange(count) * BLOCKS // count, HELD_OUT)


def inner(count: int, step: float) -> Any:
    """True but at the ends."""
    place = np.arange(count) * step
    return (place >= ENDS) & (place < count * step - ENDS)


def unbounded(error: float) -> float:
    """Infinity for an error that is not a number: the simulation ran away."""
    return error if np.isfinite(error) else np.inf


def _calibration(selection: Selection, level: float) -> Kind:
    planned = selection.recordings.misfit(selection.recordings.component.base)
    chosen: Fitted = selection.chosen
    gain = float(planned @ planned) - chosen.squared
    return "recalibrate" if gain > chi2.ppf(1 - level, max(1, len(chosen.free))) else "consistent"
