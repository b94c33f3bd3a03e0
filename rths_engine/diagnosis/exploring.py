"""The next test for an unknown: the motion that tells most about the remaining force over displacement and velocity."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rths_engine.diagnosis.components import ActuatorData, SpecimenData, Structure
from rths_engine.diagnosis.fitting import Recordings
from rths_engine.diagnosis.next_test import SHARES, Motion, motions
from rths_engine.diagnosis.surface import Surface, runs
from rths_engine.foundation.arrays import Array


@dataclass(frozen=True)
class Exploring:
    """A test for an unknown: the motion, or the factor on the recorded excitation of a structure, and what it would tell.

    `cells` counts the visited cells of displacement and velocity that the recording does not reach, and those that it does.
    `information` is in nats.
    """

    motion: Motion | None
    factor: float
    cells: tuple[int, int]
    reach: tuple[float, float]
    information: float

    @property
    def signal(self) -> str:
        return self.motion.signal if self.motion else f"the recorded excitation times {self.factor:g}"

    @property
    def tells(self) -> str:
        new, known = self.cells
        first = (
            f"It measures what is unexplained in {new} cells of displacement and velocity that the recording does not reach, "
            f"up to {1e3 * self.reach[0]:.3g} mm and {1e3 * self.reach[1]:.3g} mm/s"
        )
        again = f", and repeats {known} cells, which shows whether it depends on the history of the motion"
        return f"{first}{again if known else ''}."


def exploring(recordings: Recordings, surfaces: Sequence[Surface], stroke: float, speed: float) -> Exploring | None:
    """The test with the most information about the remaining force, within the rig's `stroke` (m) and `speed` (m/s).

    The force in a cell has a normal prior with the power of the known cells; each visit measures it with the scatter between
    visits. The information of a test is half the sum of the logarithms of the ratios of the variances before and after it
    (Lindley 1956, Ann. Math. Stat. 27, 986-1005). The tests are the sines and triangles of `motions`; for a structure, the
    recorded excitation at other amplitudes, whose drifts are taken in proportion. None where the rig can make no test.
    """
    offers: list[tuple[Motion | None, float, list[tuple[Array, Array]]]] = []
    data = recordings.data[0]
    if isinstance(data, ActuatorData | SpecimenData):
        for motion in motions(data, stroke, speed):
            offers.append((motion, 1.0, [(motion.x, np.gradient(motion.x, data.dt))]))
    elif isinstance(recordings.component, Structure):
        states = recordings.component.states(data)
        for share in SHARES:
            offers.append((None, share, [(share * one.x.values, share * one.v.values) for one in states]))
    found = [_explored(surfaces, *offer) for offer in offers]
    return max(found, key=lambda one: one.information, default=None)


def _explored(
    surfaces: Sequence[Surface], motion: Motion | None, factor: float, moved: Sequence[tuple[Array, Array]]
) -> Exploring:
    information, new, known = 0.0, 0, 0
    for surface, (x, v) in zip(surfaces, moved, strict=True):
        visited = surface.visited
        between = max(surface.between**2, float(np.mean(surface.mean[visited] ** 2)) * 1e-6, 1e-300)
        prior = float(np.mean(surface.mean[visited] ** 2)) + between
        places, inside = surface.cells(x, v)
        beyond = _beyond(surface, x, v)
        cells = np.where(inside, places, -1 - beyond)
        at, visits = np.unique([int(cells[part.start]) for part in runs(cells)], return_counts=True)
        before = np.where(at >= 0, surface.visits.ravel()[np.maximum(at, 0)], 0)
        information += 0.5 * float(np.sum(np.log((1 / prior + (before + visits) / between) / (1 / prior + before / between))))
        new += int(np.sum(before == 0))
        known += int(np.sum(before > 0))
    reach = (max(float(np.max(np.abs(x))) for x, _ in moved), max(float(np.max(np.abs(v))) for _, v in moved))
    return Exploring(motion, factor, (new, known), reach, information)


def _beyond(surface: Surface, x: Array, v: Array) -> Array:
    """A number of the cell of each sample, from 0, on the grid continued beyond the surface."""
    row, column = (
        np.floor(values / (edges[1] - edges[0]) + 0.5).astype(np.int64)
        for values, edges in ((x, surface.x.values), (v, surface.v.values))
    )
    found: Array = (row - row.min()) * (column.max() - column.min() + 1) + column - column.min()
    return found
