"""The held-out gain of an effect, with its interval over blocks."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.stats import t as student

from rths_engine.diagnosis.held_out import HeldOut
from rths_engine.foundation.arrays import Array

# chosen; see docs/decisions/0023
FELT = (
    28.0  # squared change of the output in units of the score: data that change less confirm a right effect in less than 4 of 5
)
FORESEEN = 3  # blocks: weight of the foreseen scatter of the gains beside their scatter between blocks
Rows = Sequence[Array]
Blocks = Sequence[tuple[int, slice]]


@dataclass(frozen=True)
class Scale:
    """The unit of log scores: mean square of the whitened residual (at least 1), and its correlation length in samples."""

    power: float
    memory: float

    @classmethod
    def of(cls, heldout: HeldOut, white: Rows) -> Scale:
        channels = len(heldout.recordings.noises)
        power = sum(float(np.sum(one**2)) for one in white) / max(1, channels * heldout.samples)
        return cls(max(1.0, power), heldout.memory(white))

    def scores(self, white: Rows, blocks: Blocks) -> Array:
        """Log score (blocks) of a model: -1/2 of its squared misfit, tempered to the effective number of samples."""
        sums = np.array([float(np.sum(white[place][:, cut] ** 2)) for place, cut in blocks])
        found: Array = -0.5 * sums / (self.power * self.memory)
        return found


@dataclass(frozen=True)
class Gain:
    """The mean gain in log score over the blocks, its 90 % interval, its standard error, and the gain of each data set.

    `felt` is the squared change that the effect makes to the output, in units of the score.
    """

    mean: float
    ci90: tuple[float, float]
    error: float
    felt: float
    blocks: int
    by_set: tuple[float, ...]
    other_motion: bool

    @property
    def clear(self) -> bool:
        return self.ci90[0] > 0

    @property
    def replicated(self) -> bool:
        """True where two or more held-out recordings each have a gain above zero."""
        return self.other_motion and len(self.by_set) > 1 and min(self.by_set) > 0

    @property
    def tested(self) -> bool:
        """False where the effect changes the data too little to be confirmed: a limit that is not reached, for example."""
        return self.felt > FELT


def gain(scale: Scale, white: Rows, without: Rows, blocks: Blocks, other_motion: bool) -> Gain:
    """The gain of the model with the whitened residual r over a model `without` an effect, whose residual is r + d.

    In block b, g_b = (sum (r + d)^2 - sum r^2) / (2 P) = (a_b - 1/2) D_b, where P is the power of r times the memory of r d,
    D_b = sum d^2 / P, and a_b is the share of d that block b confirms: 1 on average if the effect is right. The variance of the
    sum is seen in the scatter of a_b between blocks, sum (a_b - a)^2 D_b^2 B / (B - 1), and foreseen from that of r in them,
    sum (r d)^2 memory / P^2. Both are pooled with B - 1 and FORESEEN degrees of freedom, so that a few blocks that agree by
    chance do not make an effect certain. The motion of the blocks is taken as given, so that an effect that acts in a few
    blocks is not punished for the others.
    """
    unit = scale.power * scale.memory
    gains, sizes, inside = (np.zeros(len(blocks)) for _ in range(3))
    for number, (place, cut) in enumerate(blocks):
        r = white[place][:, cut]
        d = without[place][:, cut] - r
        sizes[number] = float(np.sum(d * d)) / unit
        gains[number] = float(np.sum(2 * r * d + d * d)) / (2 * unit)
        inside[number] = float(np.sum((r * d) ** 2)) * scale.memory / unit**2
    count, whole = len(blocks), float(sizes.sum())
    shares = np.where(sizes > 0, gains / np.maximum(sizes, 1e-300) + 0.5, 0.0)
    middle = float(np.sum(shares * sizes)) / max(whole, 1e-300)
    between = float(np.sum(((shares - middle) * sizes) ** 2)) * count / max(1, count - 1)
    free = FORESEEN + count - 1
    error = float(np.sqrt((FORESEEN * inside.sum() + (count - 1) * between) / free))
    reach = float(student.ppf(0.95, free)) * error
    total = float(gains.sum())
    sets = [place for place, _ in blocks]
    by_set = tuple(float(sum(g for g, own in zip(gains, sets, strict=True) if own == one)) for one in sorted(set(sets)))
    return Gain(
        total / count, ((total - reach) / count, (total + reach) / count), error / count, whole, count, by_set, other_motion
    )
