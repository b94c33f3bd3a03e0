"""Held-out data in contiguous blocks, and the log score of models on each block."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from rths_engine.diagnosis.ends import inner, mirrored
from rths_engine.diagnosis.fitting import RUNAWAY, Recordings
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import Part

# chosen; see docs/decisions/0023
SHORTEST, LENGTHS = 2.0, 3.0  # s, and correlation lengths of the residual: the least length of a block
LONGEST_MEMORY = 2.0  # s: the largest correlation length
MISFIT = 4.0  # mean square of a residual over that of the noise: above it, the residual is the error of the model


@dataclass(frozen=True)
class HeldOut:
    """Data that were never fitted: data sets with the mask and the weights of their samples.

    `other_motion` is true for held-out recordings and false for held-out blocks of the fitted recordings. The zero of a load
    cell is a property of the recording, so the mean of a force's residual is removed from each data set, unless `zeros_free` is
    false. `quiet` is the mean square of the residual in the quietest block, over that of the recorded channels: steady noise
    is no larger. Where the error of the models is much larger than the noise, its colour is not the noise's: residuals are
    then not whitened (`white`).
    """

    recordings: Recordings
    data: tuple[Any, ...]
    masks: tuple[Any, ...]
    weights: tuple[Array, ...]
    other_motion: bool
    zeros_free: bool = True
    white: bool = True
    quiet: float = np.inf

    @classmethod
    def of(cls, recordings: Recordings, heldout: Sequence[Any]) -> HeldOut:
        if heldout:
            masks = tuple(inner(one.measured.shape[1], one.step) for one in heldout)
            return cls(recordings, tuple(heldout), masks, tuple(np.ones(one.measured.shape) for one in heldout), True)
        masks = tuple(inner(len(mask), one.step) & ~mask for one, mask in zip(recordings.data, recordings.masks, strict=True))
        return cls(recordings, recordings.data, masks, recordings.weights, False)

    def with_fitted(self) -> HeldOut:
        """These data together with the fitted samples, for effects that these data alone cannot test."""
        fitted = self.recordings
        if not self.other_motion:
            masks = tuple(one | mask for one, mask in zip(self.masks, fitted.masks, strict=True))
            return replace(self, masks=masks)
        data, masks, weights = self.data + fitted.data, self.masks + fitted.masks, self.weights + fitted.weights
        return replace(self, data=data, masks=masks, weights=weights, other_motion=False)

    def residuals(self, parts: Sequence[Part]) -> list[Array]:
        """Recorded minus simulated output (channels, n) of each data set."""
        found = []
        for one, mask in zip(self.data, self.masks, strict=True):
            largest = RUNAWAY * np.max(np.abs(one.measured), axis=1, keepdims=True)
            simulated = np.clip(np.nan_to_num(self.recordings.component.predicted(parts, one)), -largest, largest)
            found.append(self.about_zero(one.measured - simulated, mask))
        return found

    def about_zero(self, residual: Array, mask: Any) -> Array:
        free = self.recordings.component.output == "force" and self.zeros_free and bool(mask.any())
        found: Array = residual - residual[:, mask].mean(axis=1, keepdims=True) if free else residual
        return found

    def suited(self, parts: Sequence[Part]) -> HeldOut:
        """The same data, with what the residual of the parts shows: the level of the noise, and whether it is only noise."""
        left = self.residuals(parts)
        powers = [float(np.mean(np.mean(left[place][:, cut] ** 2, axis=1) / self._powers)) for place, cut in self.blocks(1.0)]
        found = replace(self, quiet=min(powers, default=np.inf))
        return replace(found, white=self.error(left) < MISFIT * found.noise)

    def whitened(self, residuals: Sequence[Array]) -> list[Array]:
        """Residuals (channels, n) in units of the noise; zero where a sample is not held out."""
        found = []
        for residual, mask, weights in zip(residuals, self.masks, self.weights, strict=True):
            pairs = zip(mirrored(weights * residual, mask), self.recordings.noises, strict=True)
            rows = [noise.whitened(row) if self.white else row / noise.deviation for row, noise in pairs]
            found.append(np.where(mask, np.array(rows), 0.0))
        return found

    def error(self, residuals: Sequence[Array]) -> float:
        """Mean square of the residuals over the mean square of the recorded channels about their mean."""
        left = np.concatenate([one[:, mask] for one, mask in zip(residuals, self.masks, strict=True)], axis=1)
        return float(np.mean(np.mean(left**2, axis=1) / self._powers))

    @cached_property
    def noise(self) -> float:
        """The part of `error` that is measurement noise: as fitted, or `quiet` where that is clearly less."""
        fitted = float(np.mean([one.deviation**2 for one in self.recordings.noises] / self._powers))
        return self.quiet if MISFIT * self.quiet < fitted else fitted

    @cached_property
    def _powers(self) -> Array:
        real = np.concatenate([one.measured[:, mask] for one, mask in zip(self.data, self.masks, strict=True)], axis=1)
        found: Array = np.maximum(np.var(real, axis=1), 1e-300)
        return found

    @property
    def samples(self) -> int:
        return sum(int(mask.sum()) for mask in self.masks)

    def memory(self, rows: Sequence[Array], along: Sequence[Array] = ()) -> float:
        """Correlation length (samples) of rows (channels, n): 1 + 2 times the sum of the correlations to their first zero.

        With `along`, that of the products of rows and `along`: the sum of the products of both correlations, which is shorter
        where one is slow and the other oscillates. Its terms are tapered (Bartlett) instead of cut at the first zero.
        """
        shares = self._correlations(rows)
        if along:
            shares = shares * self._correlations(along) * (1 - np.arange(len(shares)) / len(shares))
        ends = np.nonzero(shares <= 0.0)[0]
        last = int(ends[0]) if len(ends) and not along else len(shares)
        return float(min(len(shares), max(1.0, 1 + 2 * shares[1:last].sum())))

    def _correlations(self, rows: Sequence[Array]) -> Array:
        """Correlations of rows (channels, n) over lags from 0 to LONGEST_MEMORY."""
        sums = np.zeros(max(1, *(round(LONGEST_MEMORY / one.step) for one in self.data)))
        for row in rows:
            size = 2 ** int(np.ceil(np.log2(2 * row.shape[1])))
            powers = np.abs(np.fft.rfft(row, size, axis=1)) ** 2
            lags = np.fft.irfft(powers, size, axis=1).sum(axis=0)[: len(sums)]
            sums[: len(lags)] += lags
        found: Array = sums / sums[0] if sums[0] > 0 else np.eye(len(sums))[0]
        return found

    def blocks(self, memory: float) -> list[tuple[int, slice]]:
        """Contiguous held-out blocks: the number of a data set and a slice of its samples. `memory` is in samples."""
        found = []
        for number, (one, mask) in enumerate(zip(self.data, self.masks, strict=True)):
            least = max(SHORTEST / one.step, LENGTHS * memory)
            edges = np.flatnonzero(np.diff(np.concatenate([[0], mask.astype(int), [0]])))
            for start, end in zip(edges[::2], edges[1::2], strict=True):
                count = max(1, int((end - start) / least))
                cuts = np.linspace(start, end, count + 1).astype(int)
                found += [(number, slice(int(low), int(high))) for low, high in itertools.pairwise(cuts)]
        return found
