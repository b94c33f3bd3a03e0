"""What the results of a sweep say: probability of exceeding a level, and dependence of a measure on each input. No SQL."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from app.models import Sweep
from app.sweeps.analysis_schemas import BarOut, FragilityOut, SensitivityOut, ShareOut
from app.sweeps.service import SweepService, columns_of
from rths_engine.foundation import units
from rths_engine.foundation.arrays import Array
from rths_engine.foundation.errors import Issue, RthsError
from rths_engine.sweeps.columns import STATUSES, Column
from rths_engine.sweeps.design import read_design
from rths_engine.sweeps.fragility import fragility
from rths_engine.sweeps.sensitivity import bars
from rths_engine.sweeps.table import Table

COMPLETED, TRIPPED = (float(STATUSES.index(name)) for name in ("completed", "tripped"))
BASES = {
    "one_at_a_time": "Each bar compares the points in which only its own field differs from the plan.",
    "": "Each bar compares the mean at the lowest and at the highest value of the field; of many values, the lowest and the "
    "highest third.",
}


class SweepAnalysis:
    """What the results of a sweep say."""

    def __init__(self, sweeps: SweepService):
        self.sweeps = sweeps

    def fragility(self, sweep_id: str, measure: str, level: float, intensity: str, tripped: bool) -> FragilityOut:
        """The probability that a measure exceeds a level. With `tripped`, a tripped point exceeds every level.

        Raises NotFound, and RthsError for a column that is not a measure or an intensity with numbers.
        """
        sweep = self.sweeps.get(sweep_id)
        table = self.sweeps.table(sweep)
        status = _values(table, "status")
        y = np.abs(_values(table, _numeric(sweep, "measure", measure, ("measure",))))
        x = _values(table, _numeric(sweep, "intensity", intensity, ("intensity", "input")))
        over = tripped & (status == TRIPPED)
        known = np.isfinite(x) & (x > 0) & (over | (np.isfinite(y) & ((status == COMPLETED) | (status == TRIPPED))))
        exceeds = over | (y > level)
        found = fragility(x[known], exceeds[known]) if known.any() else None
        if found is None:
            raise RthsError(
                Issue("intensity", "has no positive value in a point with results", intensity, "choose another intensity")
            )
        return FragilityOut(
            measure=measure,
            level=level,
            intensity=intensity,
            median=found.median,
            dispersion=found.dispersion,
            reason=found.reason,
            intensities=list(found.intensities),
            probabilities=list(found.probabilities),
            empirical=[
                ShareOut(intensity=one.intensity, points=one.points, exceeding=one.exceeding) for one in found.empirical
            ],
            points=found.points,
            exceeding=found.exceeding,
            tripped=int((over & known).sum()),
            left_out=int(len(table.points) - known.sum()),
        )

    def sensitivity(self, sweep_id: str, measure: str) -> SensitivityOut:
        """The dependence of a measure on each input, over the completed points. Raises NotFound and RthsError."""
        sweep = self.sweeps.get(sweep_id)
        table = self.sweeps.table(sweep)
        y = _values(table, _numeric(sweep, "measure", measure, ("measure", "intensity")))
        y = np.where(_values(table, "status") == COMPLETED, y, np.nan)
        own = [place for place, one in enumerate(table.columns) if one.role == "input"]
        inputs = table.values[:, own]
        alone = sweep.method == "one_at_a_time"
        planned = read_design(sweep.definition).inputs(0) if alone else None
        found = bars(inputs, y, planned)
        known = int(np.isfinite(y).sum())
        return SensitivityOut(
            measure=measure,
            mean=float(np.nanmean(y)) if known else None,
            points=known,
            left_out=len(y) - known,
            basis=BASES["one_at_a_time" if alone else ""],
            bars=[
                BarOut(
                    input=column.key,
                    label=column.label,
                    unit=units.pretty(column.shown),
                    low=one.low,
                    high=one.high,
                    low_input=_shown(column, one.low_input),
                    high_input=_shown(column, one.high_input),
                    correlation=one.correlation,
                )
                for one in found
                for column in [table.columns[own[one.place]]]
            ],
        )


def _values(table: Table, key: str) -> Array:
    """A column in its shown unit; places in the categories of a text."""
    place = [column.key for column in table.columns].index(key)
    return table.values[:, place] if table.columns[place].categories else table.shown(place)


def _numeric(sweep: Sweep, where: str, key: str, roles: Sequence[str]) -> str:
    """The key, if it is that of a column of numbers with one of these roles."""
    allowed = [one.key for one in columns_of(sweep) if one.role in roles and not one.categories]
    if key not in allowed:
        fix = f"choose one of {', '.join(allowed)}" if allowed else "this sweep has none"
        raise RthsError(Issue(where, f"is not a column of numbers with the role {' or '.join(roles)}", key, fix))
    return key


def _shown(column: Column, value: float) -> float | str:
    """An input as stored, in its shown unit; the text of a category, where the mean of several has none."""
    if column.categories:
        return column.categories[round(value)] if math.isclose(value, round(value)) else "several"
    return units.from_si(value, column.shown) if column.si else value
