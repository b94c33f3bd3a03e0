"""The results of a league, `rths-league/1`, as JSON."""

from __future__ import annotations

import json
import statistics
from collections.abc import Mapping, Sequence
from typing import Any, Literal

from pydantic import BaseModel, ConfigDict, Field

from rths_engine.foundation.errors import Issue, RthsError
from rths_engine.league.criteria import CRITERIA

Values = dict[str, float | None]


class Outcome(BaseModel):
    """One test: how it ended, when it tripped (s), and J1 to J9 up to there; null where a criterion is not defined."""

    status: str
    trip_s: float | None = None
    criteria: Values


class Spread(BaseModel):
    """Mean and sample standard deviation over the tests that completed; null below two of them."""

    completed: int
    mean: Values
    deviation: Values


class Row(BaseModel):
    """A compensator: its settings, the test without sensor noise, the nominal test, the perturbed plants and their spread."""

    kind: str
    title: str
    published: str = Field(description="Source of a published design; empty for settings by the compensator's own rule.")
    settings: dict[str, Any]
    digest: str = Field(description="Digest of the plan of the nominal test.")
    quiet: Outcome = Field(description="The nominal plant without sensor noise.")
    nominal: Outcome = Field(description="The nominal plant with the sensor noise of the benchmark.")
    plants: list[Outcome]
    spread: Spread
    made: str = Field("", description="Time of its measurement where it was measured again after the league; else empty.")
    code: str = Field("", description="Digest of the compiled loop that ran, where it was measured again.")


class League(BaseModel):
    """A league: what was run, when, by which command, and its rows in the order of `ranked`."""

    model_config = ConfigDict(validate_by_name=True, validate_by_alias=True)

    schema_: Literal["rths-league/1"] = Field("rths-league/1", alias="schema")
    made: str = Field(description="Time of the measurement, UTC, ISO 8601.")
    command: str
    code: str = Field(description="Digest of the compiled loop that ran.")
    case: int
    template: str
    record: str
    intensity: float
    plants: int
    seed: int
    elapsed_s: float
    processes: int
    rows: list[Row]


def spread(outcomes: Sequence[Outcome]) -> Spread:
    """Mean and standard deviation of each criterion over the completed tests."""
    completed = [one.criteria for one in outcomes if one.status == "completed"]
    mean: Values = {}
    deviation: Values = {}
    for criterion in CRITERIA:
        found = [value for one in completed if (value := one[criterion.symbol]) is not None]
        mean[criterion.symbol] = statistics.fmean(found) if found else None
        deviation[criterion.symbol] = statistics.stdev(found) if len(found) > 1 else None
    return Spread(completed=len(completed), mean=mean, deviation=deviation)


def ranked(rows: Sequence[Row]) -> list[Row]:
    """Rows by the mean J2 over the plants; compensators that tripped on a plant come after those that never did."""

    def place(row: Row) -> tuple[int, float]:
        tripped = len(row.plants) - row.spread.completed + (row.nominal.status != "completed")
        j2 = row.spread.mean["J2"] if row.spread.mean["J2"] is not None else row.nominal.criteria["J2"]
        return tripped, float("inf") if j2 is None else j2

    return sorted(rows, key=place)


def merged(earlier: League, again: League) -> League:
    """The earlier league with the rows of `again`, measured likewise; they replace those of the same compensators."""
    fresh = [row.model_copy(update={"made": again.made, "code": again.code}) for row in again.rows]
    replaced = {(row.kind, row.published) for row in fresh}
    kept = [row for row in earlier.rows if (row.kind, row.published) not in replaced]
    return earlier.model_copy(update={"rows": ranked([*kept, *fresh])})


def outcome(summary: Mapping[str, Any]) -> Outcome:
    """The outcome of a run from its summary."""
    trip = summary["trip"]
    criteria = {criterion.symbol: criterion.value(summary) for criterion in CRITERIA}
    return Outcome(status=summary["status"], trip_s=trip["time_s"] if trip else None, criteria=criteria)


def read(text: str, where: str) -> League:
    """A league from its JSON form. Raises RthsError, which names `where` it stands."""
    try:
        return League.model_validate(json.loads(text))
    except ValueError as error:
        raise RthsError(Issue(where, "is not a league (rths-league/1)", str(error)[:80], "run `rths league` again")) from None


def write(league: League) -> str:
    """A league as JSON with rounded numbers, so that the file of one machine equals that of another."""
    return json.dumps(_rounded(league.model_dump(mode="json", by_alias=True)), indent=1, ensure_ascii=False) + "\n"


def _rounded(found: Any) -> Any:
    if isinstance(found, dict):
        return {key: _rounded(value) for key, value in found.items()}
    if isinstance(found, list):
        return [_rounded(value) for value in found]
    return float(f"{found:.6g}") if isinstance(found, float) else found
