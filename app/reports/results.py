"""The tables of measures in the report of a test."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from rths_engine.planning.paper import PAPER
from rths_engine.recordings.run_file import Recording
from rths_engine.results.measure import FloorMeasure, Measure, RunMeasure, StationMeasure
from rths_engine.results.measures import of

PAPERS = "Chen and Ricles (2012)"
UNSTABLE = "unstable: a limit stopped the test"


@dataclass(frozen=True, slots=True)
class Row:
    """One row: its name, its cells, and whether they are published values. `instead` is text across the row."""

    name: str
    cells: list[str]
    published: bool = False
    instead: str = ""


@dataclass(frozen=True, slots=True)
class Table:
    """A table with one measure per column; `first` is the heading of the column of names."""

    caption: str
    first: str
    measures: Sequence[Measure]
    rows: list[Row]


@dataclass(frozen=True, slots=True)
class Results:
    """The results of a test: tables of stations and of floors, and the measures of the whole test."""

    stations: list[Table]
    floors: Table | None
    whole: Sequence[tuple[Measure, str]]


def results(recording: Recording) -> Results:
    """The measures of the recording's kind of test. A dash marks a measure that the recording's summary does not contain."""
    test, summary = recording.plan.test, recording.summary
    measures = of(StationMeasure, test)
    tables = []
    if summary["stations"]:
        paper = PAPER.get(recording.plan.template or "")
        caption = "Measures of each station" + (", with the published values of this simulation" if paper else "")
        tables = [
            _stations(caption, recording, [one for one in measures if not one.further], published=bool(paper)),
            _stations("Further measures of each station", recording, [one for one in measures if one.further]),
        ]
    whole = [(one, _text(one, summary.get(one.key))) for one in of(RunMeasure, test)]
    return Results(tables, _floors(recording), whole)


def _stations(caption: str, recording: Recording, measures: Sequence[Measure], published: bool = False) -> Table:
    rows = []
    for index, station in enumerate(recording.summary["stations"]):
        rows.append(Row(f"{index + 1} · {station['name']}", [_text(one, station.get(one.key)) for one in measures]))
        if published and index < 2:
            rows.append(_paper(recording.plan.template or "", index, measures))
    return Table(caption, "Station", measures, rows)


def _paper(template: str, index: int, measures: Sequence[Measure]) -> Row:
    pairs = [getattr(PAPER[template], one.key, None) for one in measures]
    if not any(pairs):
        return Row(PAPERS, [], published=True, instead=UNSTABLE)
    return Row(PAPERS, [_minus(f"{pair[index]:z.1f}") if pair else "–" for pair in pairs], published=True)


def _floors(recording: Recording) -> Table | None:
    measures = of(FloorMeasure, recording.plan.test)
    columns = [recording.summary.get(one.key) or [] for one in measures]
    count = max(map(len, columns), default=0)
    padded = [[*column, *[None] * (count - len(column))] for column in columns]
    rows = [
        Row(f"Floor {number}", [_text(one, value) for one, value in zip(measures, values, strict=True)])
        for number, values in enumerate(zip(*padded, strict=True), start=1)
    ]
    return Table("Measures of each floor", "Floor", measures, rows) if rows else None


def _text(one: Measure, value: float | None) -> str:
    return _minus(one.text(value))


def _minus(text: str) -> str:
    """The text with minus signs instead of hyphens."""
    return text.replace("-", "−")
