"""The league of compensators as text."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from app.league.trial import Trial, trial
from rths_engine.league.criteria import CRITERIA
from rths_engine.league.table import League, Outcome, Row

TITLE = 42
WIDTH = 9
WIDE = 25


def text(league: League) -> str:
    """The league as a table: nominal values with the sensor noise, those without it, and J2 over the plants."""
    other = trial(league)
    return "\n".join([*_head(league), *(_line(row, other) for row in league.rows), "", *_foot(league, other)])


def _head(league: League) -> Iterator[str]:
    yield f"Virtual RTHS benchmark, case {league.case}, record {league.record} times {league.intensity:g}"
    headings = [f"{one.symbol} {one.measure.shown_label}" for one in CRITERIA]
    more = ["J1, J2 without noise", "J2, plants", "completed", "another program J1, J2"]
    yield _columns("compensator", headings, more)


def _line(row: Row, other: Trial | None) -> str:
    completed = row.nominal.status == "completed"
    values = [row.nominal.criteria[one.symbol] if completed else None for one in CRITERIA]
    quiet = f"{digits(quiet_value(row.quiet, 'J1'))}, {digits(quiet_value(row.quiet, 'J2'))}"
    deviation = row.spread.deviation["J2"]
    plants = digits(row.spread.mean["J2"]) + ("" if deviation is None else f" ± {digits(deviation)}")
    beside = other and other.beside(row)
    theirs = f"{beside.j1_ms:g}, {beside.j2_percent:g}" if beside else ""
    more = [quiet, plants, f"{row.spread.completed} of {len(row.plants)}", theirs]
    return _columns(row.title, [digits(one) for one in values], more)


def _columns(title: str, narrow: Sequence[str], wide: Sequence[str]) -> str:
    columns = [f"{title:{TITLE}}", *(f"{one:>{WIDTH}}" for one in narrow), *(f"{one:>{WIDE}}" for one in wide)]
    return "".join(columns).rstrip()


def quiet_value(outcome: Outcome, symbol: str) -> float | None:
    """A criterion of a test that completed."""
    return outcome.criteria[symbol] if outcome.status == "completed" else None


def digits(value: float | None) -> str:
    """A value with three significant digits and at most three decimals; a dash where there is none."""
    if value is None:
        return "–"
    return f"{value:z.3f}" if abs(value) < 1 else f"{value:#.3g}".rstrip(".")


def _foot(league: League, other: Trial | None) -> Iterator[str]:
    yield "J1 to J9: nominal plant with sensor noise. J2, plants: mean ± standard deviation over the plants that completed."
    yield "A dash: the test tripped, or has no value (one plant has no standard deviation)."
    if other:
        yield f"Another program: {other.source}."
    yield f"{len(league.rows) * (league.plants + 2)} tests in {league.elapsed_s:.0f} s with {league.processes} processes."
