"""The chart of Table IV: the ratio of this program to the paper for each measure, on a logarithmic axis."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from app.table4.schemas import SimulationOut
from rths_engine.results.measures import measure
from rths_engine.table4.comparison import RATIOS

SHAPES = dict(zip(RATIOS, ("circle", "square", "diamond"), strict=True))
WIDTH, HEIGHT = 720, 260
LEFT, RIGHT, TOP, BOTTOM = 50, 12, 12, 30
LARGEST = 4.0  # ratio at the edge; larger ratios are drawn at the edge
TICKS = (1 / 3, 1 / 1.5, 1.0, 1.5, 3.0)


@dataclass(frozen=True, slots=True)
class Mark:
    """A mark in the chart of Table IV: place, shape, station and hover text."""

    x: float
    y: float
    shape: str
    station: int
    words: str


@dataclass(frozen=True, slots=True)
class Chart:
    """The chart that the template draws: marks, ticks of the ratio (y, label), simulations (x, label)."""

    marks: list[Mark]
    ticks: list[tuple[float, str]]
    simulations: list[tuple[float, str]]
    width: int = WIDTH
    height: int = HEIGHT
    left: int = LEFT
    right: int = WIDTH - RIGHT


def chart(simulations: Sequence[SimulationOut]) -> Chart | None:
    """The chart of Table IV, or None before the first simulation has ended."""
    shown = [one for one in simulations if one.paper]
    slot = (WIDTH - LEFT - RIGHT) / len(shown)
    marks, labels = [], []
    for place, one in enumerate(shown):
        labels.append((LEFT + slot * (place + 0.5), str(one.simulation)))
        if one.run is None:
            continue
        for j, station in enumerate(one.run.stations):
            for k, (field, shape) in enumerate(SHAPES.items()):
                ours, paper = getattr(station, field), getattr(one.paper, field)[j]
                if not ours:
                    continue
                x = LEFT + slot * (place + (1 + k + 3.5 * j) / 7.5)
                ratio, label = abs(ours / paper), measure(field).label
                words = f"Simulation {one.simulation}, station {j + 1}, {label}: {ratio:.2f} times the paper's value"
                marks.append(Mark(x, _height(ratio), shape, j + 1, words))
    return Chart(marks, [(_height(tick), f"{tick:.2g}") for tick in TICKS], labels) if marks else None


def _height(ratio: float) -> float:
    share = math.log(min(max(ratio, 1 / LARGEST), LARGEST)) / math.log(LARGEST)
    middle = (TOP + HEIGHT - BOTTOM) / 2
    return middle - share * (middle - TOP)
