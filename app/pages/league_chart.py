"""The two figures of the league: error against delay, and the spread of the error over the perturbed plants."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from rths_engine.league.table import Row

WIDTH, HEIGHT = 560, 320
LEFT, RIGHT, TOP, BOTTOM = 52, 16, 14, 44
LANE = 26  # height of a compensator in the figure of spreads


@dataclass(frozen=True, slots=True)
class Mark:
    """A mark: place, number of its row in the table, hover text, and whether the design is a published one."""

    x: float
    y: float
    number: int
    words: str
    published: bool


@dataclass(frozen=True, slots=True)
class Lane:
    """The spread of a compensator: its height, its number, J2 of each plant, of the mean, and hover text."""

    y: float
    number: int
    plants: list[float]
    mean: float
    words: str
    published: bool


@dataclass(frozen=True, slots=True)
class Figure:
    """A figure: its marks or lanes, ticks of both axes (place, label), and its size."""

    marks: list[Mark]
    lanes: list[Lane]
    across: list[tuple[float, str]]
    up: list[tuple[float, str]]
    width: int = WIDTH
    height: int = HEIGHT
    left: int = LEFT
    right: int = WIDTH - RIGHT
    top: int = TOP
    bottom: int = HEIGHT - BOTTOM


def delay_and_error(rows: Sequence[Row]) -> Figure | None:
    """J2 (logarithmic) against J1 of the tests without noise that completed; None where there are none."""
    shown = [
        (number, row, row.quiet.criteria["J1"], row.quiet.criteria["J2"])
        for number, row in enumerate(rows, start=1)
        if row.quiet.status == "completed"
    ]
    points = [(number, row, j1, j2) for number, row, j1, j2 in shown if j1 is not None and j2]
    if not points:
        return None
    low, high = min(0.0, *(j1 for *_, j1, _ in points)), max(0.0, *(j1 for *_, j1, _ in points))
    margin = 0.08 * (high - low) or 1.0
    low, high = low - margin, high + margin
    decades = _Decades([j2 for *_, j2 in points], HEIGHT - BOTTOM, TOP)

    def across(j1: float) -> float:
        return LEFT + (j1 - low) / (high - low) * (WIDTH - LEFT - RIGHT)

    marks = []
    for number, row, j1, j2 in points:
        words = f"{number}. {row.title}: J1 {j1:.2f} ms, J2 {j2:.2f} %"
        marks.append(Mark(across(j1), decades.place(j2), number, words, bool(row.published)))
    step = _step(high - low)
    ticks = [(across(k * step), f"{k * step:g}") for k in range(math.ceil(low / step), math.floor(high / step) + 1)]
    return Figure(marks, [], ticks, decades.ticks)


def spreads(rows: Sequence[Row]) -> Figure | None:
    """J2 of each completed perturbed plant, a lane for each compensator; None where no plant completed."""
    completed = [
        (number, row, [j2 for one in row.plants if one.status == "completed" and (j2 := one.criteria["J2"])])
        for number, row in enumerate(rows, start=1)
    ]
    shown = [(number, row, values) for number, row, values in completed if values]
    if not shown:
        return None
    height = TOP + LANE * len(shown) + BOTTOM
    decades = _Decades([value for *_, values in shown for value in values], LEFT, WIDTH - RIGHT)
    lanes = []
    for place, (number, row, values) in enumerate(shown):
        mean = sum(values) / len(values)
        words = f"{number}. {row.title}: J2 {min(values):.2f} to {max(values):.2f} %, mean {mean:.2f} %"
        y = TOP + LANE * (place + 0.5)
        lanes.append(Lane(y, number, [decades.place(one) for one in values], decades.place(mean), words, bool(row.published)))
    return Figure([], lanes, decades.ticks, [], height=height, bottom=height - BOTTOM)


class _Decades:
    """A logarithmic axis over values, from the place `first` to the place `last`, with ticks at 1, 2 and 5."""

    def __init__(self, values: Sequence[float], first: float, last: float):
        self.low, self.high = math.log10(min(values) / 1.3), math.log10(max(values) * 1.3)
        self.first, self.last = first, last
        powers = range(math.floor(self.low), math.ceil(self.high) + 1)
        steps = [digit * 10.0**power for power in powers for digit in (1, 2, 5)]
        self.ticks = [(self.place(one), f"{one:g}") for one in steps if self.low <= math.log10(one) <= self.high]

    def place(self, value: float) -> float:
        share = (math.log10(value) - self.low) / (self.high - self.low)
        return self.first + share * (self.last - self.first)


def _step(span: float) -> float:
    """A round step that gives four to nine ticks over a span."""
    power = 10.0 ** math.floor(math.log10(span))
    return next(one * power for one in (0.1, 0.2, 0.5, 1.0) if span / (one * power) <= 9)
