"""The verdict on one component."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from scipy.stats import chi2

from rths_engine.diagnosis.claims import Claims, proved
from rths_engine.diagnosis.components import Component
from rths_engine.diagnosis.ends import inner
from rths_engine.diagnosis.fitting import Fitted, Recordings
from rths_engine.diagnosis.noise import Noise
from rths_engine.diagnosis.schema import Kind
from rths_engine.diagnosis.select import Selection, select
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import Part

# chosen; see docs/decisions/0023
BLOCKS, HELD_OUT = 10, (2, 5, 8)  # successive blocks of a recording; blocks held out where no recording is held out
PLAIN = 25.0  # squared length in units of the noise: an unknown law must exceed it
NOT_WHOLE = 1 / 3  # largest share of the chi^2 beyond the planned model that named effects may leave to a general law
MOST = 0.1  # share of the held-out power of the error: effects that leave less are named whatever the general law explains
MORE_THAN_HALF, DOUBTFUL = 0.5, 0.05  # as NOT_WHOLE, where the p-value of the general law is at most DOUBTFUL


@dataclass(frozen=True)
class Judged:
    """The judgement of one component: its selection, its verdict, its held-out recordings, and the proof of its claims.

    `proof` is None where no mismatch was detected.
    """

    component: Component
    name: str
    selection: Selection
    verdict: Kind
    unknown: bool
    heldout: tuple[Any, ...]
    proof: Claims | None = None

    @property
    def recordings(self) -> Recordings:
        return self.selection.recordings

    @property
    def effects(self) -> tuple[Part, ...]:
        """The effects of the extended model; empty where none is named."""
        refused = self.unknown or (self.proof is not None and not self.proof.claims)
        return () if refused else self.selection.effects

    @property
    def gain(self) -> float:
        """The chi^2 beyond the refitted planned parts: explained by the effects, plus explained by a general law after them."""
        return self.selection.baseline.squared - self.selection.chosen.squared + self.left

    @property
    def left(self) -> float:
        """The chi^2 of the residual that a general law explains after the effects are fitted, beyond its expected value."""
        last = self.selection.detections[-1]
        return max(0.0, last.explained - last.expected)

    @cached_property
    def unproved(self) -> float:
        """The share of the held-out power of the error that remains with the effects."""
        before, after = (self.nrmse(one.parts, False) for one in (self.selection.baseline, self.selection.chosen))
        return after**2 / max(before**2, 1e-300)

    def remains(self, level: float) -> bool:
        """True where a general law explains too much of the residual for the fitted effects to be the left-out physics."""
        chance = self.selection.detections[-1].p_general
        return self.left > PLAIN and (
            (chance <= level and self.left > NOT_WHOLE * self.gain)
            or (chance <= DOUBTFUL and self.left > MORE_THAN_HALF * self.gain)
        )

    def nrmse(self, parts: Sequence[Part], fitted: bool | None) -> float:
        """RMS error over the RMS of the measured channels about their mean, on fitted, held-out or all (None) samples.

        All channels have equal weights. Infinite where the simulation diverges.
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
        """The noise floor: RMS noise over the RMS of the measured channels about their mean."""
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
    """Fit one component, detect a mismatch, select the left-out effects and judge the component.

    `level` is the false-alarm rate of the component. `told` receives the share of the work that is done.
    """
    used = inner if heldout else fitted_blocks
    masks = tuple(used(one.measured.shape[1], one.step) for one in data)
    noises = tuple(Noise.white(1.0) for _ in data[0].measured)
    weights = tuple(np.ones(one.measured.shape) for one in data)
    selection = select(Recordings(component, tuple(data), masks, noises, weights, weights), level, random, told)
    component.settle(selection.chosen.parts, heldout)
    kept = tuple(heldout)
    if selection.detections[0].p_value > level:
        return Judged(component, name, selection, _calibration(selection, level), False, kept)
    proof = proved(selection, kept, random)
    found = Judged(component, name, proof.selection, "mismatch", False, kept, proof)
    remains = found.remains(level)
    if proof.claims:
        whole = not remains or found.unproved <= MOST
        return found if whole else replace(found, proof=proof.as_part())
    unknown = remains or (proof.clear and not proof.undecided)
    return replace(found, verdict="mismatch" if unknown else "undetermined", unknown=unknown)


def fitted_blocks(count: int, step: float) -> Any:
    """Mask of the fitted samples where three blocks are held out."""
    return inner(count, step) & ~np.isin(np.arange(count) * BLOCKS // count, HELD_OUT)


def unbounded(error: float) -> float:
    """The error, or infinity where it is not finite because the simulation diverged."""
    return error if np.isfinite(error) else np.inf


def _calibration(selection: Selection, level: float) -> Kind:
    """`recalibrate` where the refitted planned parameters improve the fit significantly, else `consistent`."""
    planned = selection.recordings.misfit(selection.recordings.component.base)
    chosen: Fitted = selection.chosen
    gain = float(planned @ planned) - chosen.squared
    return "recalibrate" if gain > chi2.ppf(1 - level, max(1, len(chosen.free))) else "consistent"
