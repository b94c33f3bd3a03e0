"""The declaration of a measure: its meaning, its label and unit for people, and its computation."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

from rths_engine.foundation import units
from rths_engine.results.signals import RunSignals, StationSignals
from rths_engine.results.sums import RunSums, StationSums


@dataclass(frozen=True, kw_only=True)
class Measure:
    """A number computed from the record of a test. Subclasses define its scope and compute it.

    `key` names it in results, the database, REST and files, and ends with its shown unit. `unit` is SI and `shown` the unit in
    which people read it, with `decimals`. `tests` are the kinds of test in which it applies. `formula` uses the symbols
    of the channels (docs/glossary.md). `further` measures stand in a second table; `listed` ones stand in lists of runs too.
    """

    scope: ClassVar[str]

    key: str
    label: str
    symbol: str
    unit: str
    shown: str
    decimals: int
    tests: tuple[str, ...]
    formula: str
    meaning: str
    source: str
    further: bool = False
    listed: bool = False

    @property
    def factor(self) -> float:
        """SI value of one shown unit."""
        return units.factor(self.shown)

    @property
    def shown_label(self) -> str:
        return units.pretty(self.shown)

    @property
    def heading(self) -> str:
        """Label with unit: `MTE, mm`."""
        return f"{self.label}, {self.shown_label}" if self.shown_label else self.label

    def in_shown(self, value: float | None) -> float | None:
        """An SI value in the shown unit; None for a value that is not finite."""
        return None if value is None or not math.isfinite(value) else value * (1 / self.factor)

    def text(self, value: float | None) -> str:
        """A shown value with the measure's decimals; a dash where there is none."""
        return "–" if value is None else f"{value:z.{self.decimals}f}"

    def as_dict(self) -> dict[str, Any]:
        """JSON form of the declaration."""
        return {
            "key": self.key,
            "label": self.label,
            "symbol": self.symbol,
            "unit": self.unit,
            "shown": self.shown,
            "shown_label": self.shown_label,
            "factor": self.factor,
            "decimals": self.decimals,
            "scope": self.scope,
            "tests": list(self.tests),
            "formula": self.formula,
            "meaning": self.meaning,
            "source": self.source,
            "further": self.further,
            "listed": self.listed,
        }


@dataclass(frozen=True, kw_only=True)
class StationMeasure(Measure):
    """A measure of each station.

    `compute` makes it from the whole record of the station. `so_far` makes it from sums over the samples so far, while the test
    runs; without it a running test shows a dash. Both give SI, or None where the measure is not defined.
    """

    scope: ClassVar[str] = "station"

    compute: Callable[[StationSignals], float | None]
    so_far: Callable[[StationSums], float | None] | None = None


@dataclass(frozen=True, kw_only=True)
class RunMeasure(Measure):
    """A measure of the whole test; `compute` and `so_far` as in `StationMeasure`."""

    scope: ClassVar[str] = "run"

    compute: Callable[[RunSignals], float | None]
    so_far: Callable[[RunSums], float | None] | None = None


@dataclass(frozen=True, kw_only=True)
class FloorMeasure(Measure):
    """A measure of each floor, known once the test has ended; `compute` gives one SI value a floor."""

    scope: ClassVar[str] = "floor"

    compute: Callable[[RunSignals], Sequence[float]]
