"""Comparison of our table with the published table: outcomes, signs and ratios."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np

from rths_engine.planning.paper import PAPER as ROWS
from rths_engine.planning.paper import PaperRow
from rths_engine.results.measures import measure

PAPER = {row.simulation: row for row in ROWS.values()}
# Chen and Ricles (2012); the simulations that numbers were calibrated on: docs/table4.md
FLOORS_PEAK_MM = (49.6, 94.6)  # of simulation 2
DRIFTS_PERCENT = (1.1, 1.2)  # of simulation 2
CALIBRATED = (3, 4)  # simulations used to choose parameters
FLOORS_PEAK = "floors_peak_mm"
MEASURES = ("mte_mm", "rms_percent", "mti_mm2", "mee_kNm")
RATIOS = ("mte_mm", "rms_percent", "mti_mm2")
SIGNED = ("mti_mm2", "mee_kNm")


@dataclass(frozen=True, slots=True)
class Row:
    """One simulation of the table: how it ended, when it tripped (s), and its stations' measures as in a run's summary."""

    simulation: int
    status: str
    trip_s: float | None
    stations: list[dict[str, Any]]


@dataclass(frozen=True, slots=True)
class Comparison:
    """`factors` are exp |ln(ours/paper)| of MTE, RMS and MTI of the simulations that were stable in the paper."""

    outcomes_right: int
    outcomes_wrong: tuple[int, ...]
    signs_right: int
    signs_wrong: tuple[str, ...]
    factors: tuple[float, ...]

    @property
    def median(self) -> float:
        return float(np.median(self.factors))

    @property
    def worst(self) -> float:
        return max(self.factors)


def comparison(rows: Iterable[Row]) -> Comparison:
    """Compare our rows with the paper's: outcomes, signs, and factors between the measures."""
    outcomes_wrong, signs_right, signs_wrong, factors = [], 0, [], []
    rows = list(rows)
    for row in rows:
        paper = PAPER[row.simulation]
        if (row.status == "completed") != stable(paper):
            outcomes_wrong.append(row.simulation)
        if not stable(paper):
            continue
        for j, station in enumerate(row.stations):
            factors += [factor(station[field], published(paper, field, j)) for field in RATIOS]
            for field in SIGNED:
                right = station[field] * published(paper, field, j) > 0
                signs_right += right
                if not right:
                    signs_wrong.append(f"simulation {row.simulation}, station {j + 1}, {measure(field).label}")
    return Comparison(len(rows) - len(outcomes_wrong), tuple(outcomes_wrong), signs_right, tuple(signs_wrong), tuple(factors))


def stable(paper: PaperRow) -> bool:
    """Whether the paper's simulation was stable. The paper gives measures of stable simulations only."""
    return paper.mte_mm is not None


def published(paper: PaperRow, field: str, station: int) -> float:
    """A published measure of a simulation that was stable."""
    pair: Any = getattr(paper, field)
    return float(pair[station])


def factor(ours: float, paper: float) -> float:
    """Factor exp |ln |ours/paper|| between a measure and the paper's, at least 1; infinite where ours is 0."""
    return math.exp(abs(math.log(abs(ours / paper)))) if ours else math.inf
