"""The remaining force as a surface over displacement and velocity (Masri and Caughey 1979, J. Appl. Mech. 46, 433-447)."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from rths_engine.diagnosis.components import Structure
from rths_engine.diagnosis.components.component import Signal, State
from rths_engine.diagnosis.fitting import Recordings
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.part import Part

# chosen; see docs/decisions/0023
CELLS, STOREY_CELLS = 9, 5  # of each axis; of each axis for a storey, whose cells cost a replay each
FEWEST = 10  # samples in a cell of a storey, whose force is fitted

Counts = NDArray[np.int64]


@dataclass(frozen=True)
class Surface:
    """The mean remaining force in each cell of displacement and velocity, with its standard error and its counts.

    The cells are equal steps from minus to plus the largest displacement and velocity. `mean` is NaN where no sample lies, and
    `error` is NaN where it cannot be computed. The force is that of the recording minus that of the model; an actuator has a
    displacement in its place.
    """

    place: str
    x: Signal  # label and units; the values are the edges of the cells
    v: Signal
    mean: Array  # (displacement, velocity)
    error: Array
    samples: Counts
    visits: Counts

    def shaped(self, shape: tuple[int, int]) -> Surface:
        """The surface with its cells in rows of equal displacement."""
        mean, error = self.mean.reshape(shape), self.error.reshape(shape)
        return replace(self, mean=mean, error=error, samples=self.samples.reshape(shape), visits=self.visits.reshape(shape))

    @property
    def visited(self) -> NDArray[np.bool_]:
        found: NDArray[np.bool_] = np.isfinite(self.mean)
        return found

    @property
    def between(self) -> float:
        """Standard deviation of the force between visits of a cell, pooled over the cells; 0 where no cell has two visits."""
        several = np.isfinite(self.error) & (self.visits > 1)
        if not several.any():
            return 0.0
        return float(np.sqrt(np.mean(self.error[several] ** 2 * self.visits[several])))

    def cells(self, x: Array, v: Array) -> tuple[Counts, NDArray[np.bool_]]:
        """The number of the cell of each sample, and whether the sample lies inside the surface."""
        return _cells(self.x.values, self.v.values, x, v)

    def at(self, x: Array, v: Array) -> Array:
        """The remaining force at a displacement and a velocity; 0 where the surface has no sample."""
        places, inside = self.cells(x, v)
        found: Array = np.where(inside, np.nan_to_num(self.mean).ravel()[places], 0.0)
        return found


def surfaces(recordings: Recordings, parts: Sequence[Part]) -> list[Surface]:
    """The surfaces of the residual beside the model `parts` on the fitted samples: one for each storey of a structure."""
    states = [recordings.component.states(one) for one in recordings.data]
    storeys = isinstance(recordings.component, Structure)
    grids = [_grid([row[place] for row in states], STOREY_CELLS if storeys else CELLS) for place in range(len(states[0]))]
    return _fitted(recordings, parts, states, grids) if storeys else [_averaged(recordings, parts, states, grids[0])]


def _grid(states: Sequence[State], cells: int) -> State:
    """The edges of the cells, which cover all recordings."""

    def edges(signals: Sequence[Signal]) -> Signal:
        end = max(1e-300, *(float(np.max(np.abs(one.values))) for one in signals))
        return signals[0]._replace(values=end * np.linspace(-1.0, 1.0, cells + 1))

    return State(states[0].place, edges([one.x for one in states]), edges([one.v for one in states]))


def _cells(x_edges: Array, v_edges: Array, x: Array, v: Array) -> tuple[Counts, NDArray[np.bool_]]:
    rows, columns = (
        np.clip(np.searchsorted(edges, values, "right") - 1, 0, len(edges) - 2)
        for edges, values in ((x_edges, x), (v_edges, v))
    )
    inside = (np.abs(x) <= x_edges[-1] * (1 + 1e-9)) & (np.abs(v) <= v_edges[-1] * (1 + 1e-9))
    return rows * (len(v_edges) - 1) + columns, inside


def _averaged(recordings: Recordings, parts: Sequence[Part], states: Sequence[list[State]], grid: State) -> Surface:
    """The mean of the residual in each cell. Its standard error comes from the means of successive visits of the cell."""
    shape = (len(grid.x.values) - 1, len(grid.v.values) - 1)
    cells, sums, lengths = [], [], []
    for (state,), residual, mask in zip(states, recordings.residuals(parts), recordings.masks, strict=True):
        places, _ = _cells(grid.x.values, grid.v.values, state.x.values, state.v.values)
        for part in runs(np.where(mask, places, -1)):
            if mask[part.start]:
                cells.append(int(places[part.start]))
                sums.append(float(np.sum(residual[0, part])))
                lengths.append(part.stop - part.start)
    at, total, count = np.array(cells, dtype=np.int64), np.array(sums), np.array(lengths)
    samples = np.bincount(at, count, minlength=shape[0] * shape[1]).astype(np.int64)
    visits = np.bincount(at, minlength=len(samples))
    with np.errstate(divide="ignore", invalid="ignore"):
        mean = np.where(samples > 0, np.bincount(at, total, minlength=len(samples)) / samples, np.nan)
        apart = np.bincount(at, (count * (total / count - mean[at])) ** 2, minlength=len(samples))
        error = np.where(visits > 1, np.sqrt(apart * visits / (visits - 1)) / samples, np.nan)
    return Surface(grid.place, grid.x, grid.v, mean, error, samples, visits).shaped(shape)


def runs(places: Counts) -> Iterable[slice]:
    """The slices of equal successive places."""
    edges = [0, *(np.flatnonzero(np.diff(places)) + 1), len(places)]
    return (slice(int(low), int(high)) for low, high in pairwise(edges) if high > low)


def _fitted(
    recordings: Recordings, parts: Sequence[Part], states: Sequence[list[State]], grids: Sequence[State]
) -> list[Surface]:
    """The storey forces whose responses fit the residual best, one for each cell of each storey.

    Least squares of the whitened residual. A cell's force has a prior of mean zero, whose standard deviation is the largest
    elastic force of the storey, so that cells that the recording does not determine stay near zero with a large error.
    """
    component, data, cells = recordings.component, recordings.data, STOREY_CELLS**2
    before = recordings.predicted(parts)
    tops = [one.f for one in component.seen(data[0])]
    pairs = [zip(grids, row, strict=True) for row in states]
    at = [[_cells(grid.x.values, grid.v.values, one.x.values, one.v.values)[0] for grid, one in row] for row in pairs]
    samples, visits = np.zeros((2, len(grids), cells), dtype=np.int64)
    for row in at:
        for storey, places in enumerate(row):
            samples[storey] += np.bincount(places, minlength=cells)
            visits[storey] += np.bincount([int(places[part.start]) for part in runs(places)], minlength=cells)
    owners = [(int(storey), int(cell)) for storey, cell in np.argwhere(samples >= FEWEST)]
    columns = []
    for storey, cell in owners:
        change = []
        for one, row, old in zip(data, at, before, strict=True):
            added = [np.zeros(len(places)) for places in row]
            added[storey][row[storey] == cell] = tops[storey]
            change.append(component.loaded(parts, one, added) - old)
        columns.append(recordings.joined(change))
    table, misfit = np.array(columns).T, recordings.misfit(parts)
    inverse = np.linalg.inv(table.T @ table + np.eye(table.shape[1]))
    shares = inverse @ (table.T @ misfit)
    left = misfit - table @ shares
    spread = np.sqrt(np.diag(inverse) * max(1.0, float(left @ left) / len(left)))
    mean, error = np.full((2, len(grids), cells), np.nan)
    for (storey, cell), share, size in zip(owners, shares, spread, strict=True):
        mean[storey, cell], error[storey, cell] = tops[storey] * share, tops[storey] * size
    flat = (Surface(grid.place, grid.x, grid.v, mean[k], error[k], samples[k], visits[k]) for k, grid in enumerate(grids))
    return [one.shaped((STOREY_CELLS, STOREY_CELLS)) for one in flat]
