"""The nine criteria J1 to J9 of the benchmark, each a measure of the table of measures."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from rths_engine.results.measure import FloorMeasure, Measure
from rths_engine.results.measures import measure


@dataclass(frozen=True, slots=True)
class Criterion:
    """A criterion: its name in the benchmark and in words, its measure, and the floor (from 1) where the measure has floors."""

    symbol: str
    words: str
    key: str
    floor: int | None = None

    @property
    def measure(self) -> Measure:
        return measure(self.key)

    @property
    def meaning(self) -> str:
        where = f" (floor {self.floor})" if self.floor else ""
        return self.measure.meaning + where

    def value(self, summary: Mapping[str, Any]) -> float | None:
        """Its value in the summary of a run, in the unit shown; None where it is not defined."""
        if isinstance(self.measure, FloorMeasure):
            floors = summary[self.key]
            assert self.floor is not None
            return floors[self.floor - 1] if len(floors) >= self.floor else None
        found: float | None = summary["stations"][0][self.key]
        return found


# Silva, Gomez, Maghareh, Dyke and Spencer (2020), section 4
CRITERIA = (
    Criterion("J1", "delay", "delay_ms"),
    Criterion("J2", "tracking error, RMS", "rms_percent"),
    Criterion("J3", "tracking error, largest", "peak_error_percent"),
    Criterion("J4", "error to the whole structure, RMS", "reference_rms_percent"),
    Criterion("J5", "error to the whole structure, largest", "reference_peak_percent"),
    Criterion("J6", "floor 2 to the whole structure, RMS", "floors_reference_rms_percent", 2),
    Criterion("J7", "floor 3 to the whole structure, RMS", "floors_reference_rms_percent", 3),
    Criterion("J8", "floor 2 to the whole structure, largest", "floors_reference_peak_percent", 2),
    Criterion("J9", "floor 3 to the whole structure, largest", "floors_reference_peak_percent", 3),
)
