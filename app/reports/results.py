"""The measures of a test as tables of its report: a row for each measure, a column for each station or floor."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from app.reports.document import Block, Head, Table, Text
from app.reports.published import published
from rths_engine.planning.paper import PaperRow
from rths_engine.recordings.run_file import Recording
from rths_engine.results.measure import FloorMeasure, Measure, RunMeasure, StationMeasure
from rths_engine.results.measures import of

PAPERS = "Chen and Ricles (2012)"
UNSTABLE = "Chen and Ricles (2012) report this simulation as unstable: a limit stopped the test."
AT_ONCE = 4  # stations in one table
FLOORS_AT_ONCE = 8
MEANING = Head("Meaning", share=3.0)


def results(recording: Recording) -> list[Block]:
    """The measures of the recording's kind of test. A dash marks a measure that the recording's summary does not contain."""
    test, summary = recording.plan.test, recording.summary
    measures = of(StationMeasure, test)
    blocks: list[Block] = []
    if summary["stations"]:
        paper = published(recording)
        further = [one for one in measures if one.further]
        blocks += _stations("Measures of each station", recording, [one for one in measures if not one.further], paper)
        if paper and not any(getattr(paper, one.key, None) for one in measures):
            blocks.append(Text([UNSTABLE], "note"))
        blocks += _stations("Further measures of each station", recording, further)
    return [*blocks, *_floors(recording), *_whole(recording)]


def _stations(caption: str, recording: Recording, measures: Sequence[Measure], row: PaperRow | None = None) -> list[Table]:
    """Tables of at most AT_ONCE stations. The measures of the paper's row follow the column of their station."""
    stations = list(enumerate(recording.summary["stations"], start=1))
    tables = []
    for first in range(0, len(stations), AT_ONCE):
        columns: list[tuple[str, Mapping[str, Any]]] = []
        for number, station in stations[first : first + AT_ONCE]:
            columns.append((f"{number} · {station['name']}", {one.key: _text(one, station.get(one.key)) for one in measures}))
            paper = _paper(row, number, measures) if row else {}
            if paper:
                columns.append((PAPERS, paper))
        heads = [Head("Measure", share=1.6), *(Head(name, number=True) for name, _ in columns), MEANING]
        rows = [[one.heading, *(cells[one.key] for _, cells in columns), one.meaning] for one in measures]
        tables.append(Table(caption if not first else f"{caption}, continued", heads, rows))
    return tables


def _paper(row: PaperRow, number: int, measures: Sequence[Measure]) -> dict[str, str]:
    """The published measures of a station; empty where the paper gives none."""
    pairs = {one.key: getattr(row, one.key, None) for one in measures}
    if number > 2 or not any(pairs.values()):
        return {}
    return {key: _minus(f"{pair[number - 1]:z.1f}") if pair else "–" for key, pair in pairs.items()}


def _floors(recording: Recording) -> list[Table]:
    """Tables of at most FLOORS_AT_ONCE floors."""
    measures = [one for one in of(FloorMeasure, recording.plan.test) if recording.summary.get(one.key)]
    columns = [recording.summary[one.key] for one in measures]
    count = max(map(len, columns), default=0)
    padded = [[*column, *[None] * (count - len(column))] for column in columns]
    tables = []
    for first in range(0, count, FLOORS_AT_ONCE):
        part = range(first, min(count, first + FLOORS_AT_ONCE))
        heads = [Head("Measure", share=1.6), *(Head(f"Floor {floor + 1}", number=True) for floor in part), MEANING]
        rows = [
            [one.heading, *(_text(one, values[floor]) for floor in part), one.meaning]
            for one, values in zip(measures, padded, strict=True)
        ]
        tables.append(Table("Measures of each floor", heads, rows))
    return tables


def _whole(recording: Recording) -> list[Table]:
    measures = of(RunMeasure, recording.plan.test)
    rows = [[one.heading, _text(one, recording.summary.get(one.key)), one.meaning] for one in measures]
    heads = [Head("Measure", share=1.6), Head("Test", number=True), MEANING]
    return [Table("Measures of the whole test", heads, rows)] if rows else []


def _text(one: Measure, value: float | None) -> str:
    return _minus(one.text(value))


def _minus(text: str) -> str:
    """The text with minus signs instead of hyphens."""
    return text.replace("-", "−")
