"""The league of compensators as text."""

from __future__ import annotations

from collections.abc import Iterator

from rths_engine.league.criteria import CRITERIA
from rths_engine.league.table import League, Outcome, Row

TITLE = 60
WIDTH = 9


def text(league: League) -> str:
    """The league as a table: nominal values with the sensor noise, and J2 without it and over the plants."""
    return "\n".join([*_head(league), *map(_line, league.rows), "", *_foot(league)])


def _head(league: League) -> Iterator[str]:
    yield f"Virtual RTHS benchmark, case {league.case}, record {league.record} times {league.intensity:g}"
    headings = [f"{one.symbol} {one.measure.shown_label}" for one in CRITERIA]
    more = ["quiet J2", "plants J2", "+-", "stable"]
    yield f"{'compensator':{TITLE}}" + "".join(f"{heading:>{WIDTH}}" for heading in (*headings, *more))


def _line(row: Row) -> str:
    values = [row.nominal.criteria[one.symbol] for one in CRITERIA] if row.nominal.status == "completed" else [None] * 9
    more = [_j2(row.quiet), row.spread.mean["J2"], row.spread.deviation["J2"]]
    stable = f"{row.spread.completed}/{len(row.plants)}"
    return f"{row.title:{TITLE}}" + "".join(map(number, (*values, *more))) + f"{stable:>{WIDTH}}"


def _j2(outcome: Outcome) -> float | None:
    return outcome.criteria["J2"] if outcome.status == "completed" else None


def number(value: float | None) -> str:
    """A value with three significant digits; a dash where a test tripped."""
    return f"{'–' if value is None else f'{value:#.3g}':>{WIDTH}}"


def _foot(league: League) -> Iterator[str]:
    yield "A dash: the test tripped. quiet: without sensor noise. plants: mean and standard deviation over perturbed plants."
    yield f"{len(league.rows) * (league.plants + 2)} tests in {league.elapsed_s:.0f} s with {league.processes} processes."
