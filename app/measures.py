"""The engine's table of measures as fields of JSON and as rows of a table."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from pydantic import Field

from rths_engine.results.measure import FloorMeasure, Measure, RunMeasure, StationMeasure
from rths_engine.results.measures import of


def fields(scope: type[Measure], kind: Any) -> dict[str, Any]:
    """Fields of a pydantic model, one for each measure of the scope: `kind` or null, with heading, unit and meaning."""
    return {
        one.key: (
            kind | None,
            Field(title=one.heading, description=f"{one.meaning}; {one.formula}", json_schema_extra={"unit": one.shown_label}),
        )
        for one in of(scope)
    }


def rows(run: Any, test: str) -> Iterator[tuple[str, Measure, float | None]]:
    """Every measure that applies to the kind of test: station or floor, measure, value in the unit shown. `run` is JSON."""
    for station in run["stations"]:
        for one in of(StationMeasure, test):
            yield station["name"], one, station.get(one.key)
    for floor in of(FloorMeasure, test):
        for number, value in enumerate(run.get(floor.key) or [], start=1):
            yield f"Floor {number}", floor, value
    for whole in of(RunMeasure, test):
        yield "whole test", whole, run.get(whole.key)
