"""The delay margin of a station, and the spectral radius over the delays of two stations."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from rths_engine.foundation.arrays import Array
from rths_engine.stability.closed_loop import ClosedLoop, stable
from rths_engine.stability.station import delay

# chosen; see docs/decisions/0023
MOST = 1000.0  # largest added delay searched, in controller steps
STEPS = np.concatenate([np.arange(1.0, 10.0), np.geomspace(10.0, MOST, 60)])
POINTS = 41


@dataclass(frozen=True, slots=True)
class Axis:
    """Delays of one station in a map: the alpha of a first-order actuator, or controller steps of delay added to another."""

    station: int
    label: str
    present: float
    values: Array


@dataclass(frozen=True, slots=True)
class Map:
    """radius[k, l] at value l of the first axis and value k of the second."""

    first: Axis
    second: Axis
    radius: Array


def margin(loop: ClosedLoop, j: int) -> float | None:
    """Delay margin of station j in controller steps: the added delay at which the spectral radius rho first exceeds 1.

    The first crossing, to 1e-4 steps, on a grid that is finer at small delays. 0 when the loop is unstable without added delay;
    None when it is stable up to MOST steps.
    """

    def holds(added: float) -> bool:
        return stable(loop.radius({j: loop.station(j, added)}))

    if not holds(0.0):
        return 0.0
    return crossing(holds, np.concatenate([[0.0], STEPS]))


def crossing(holds: Callable[[float], bool], grid: Array) -> float | None:
    """The value at which `holds` changes, between the first pair of grid values with a change; None without a change."""
    low = float(grid[0])
    for high in map(float, grid[1:]):
        if not holds(high):
            while high - low > 1e-4:
                middle = 0.5 * (low + high)
                low, high = (middle, high) if holds(middle) else (low, middle)
            return low
        low = high
    return None


def delay_map(loop: ClosedLoop, first: int = 0, second: int = 1, points: int = POINTS) -> Map:
    """The radius over the delays of two stations, over a range that includes the stability limit where there is one."""
    axes = [_axis(loop, j, points) for j in (first, second)]
    lifted = [[loop.station(axis.station, value - axis.present) for value in axis.values] for axis in axes]
    radius = np.array([loop.radii([loop.matrix({first: one, second: two}) for one in lifted[0]]) for two in lifted[1]])
    return Map(axes[0], axes[1], radius)


def _axis(loop: ClosedLoop, j: int, points: int) -> Axis:
    own, station = delay(loop.plan.stations[j]), loop.plan.stations[j]
    least, present = (0.0, 0.0) if own is None else (1.0, own)
    reach = margin(loop, j)
    most = max(least + 20.0, 1.3 * (present + (reach if reach is not None else present)))
    label = f"Added delay of {station.name}, controller steps" if own is None else f"α of {station.name}"
    return Axis(j, label, present, np.linspace(least, min(most, least + MOST), points))
