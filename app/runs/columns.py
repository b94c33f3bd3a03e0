"""The columns of the run table: facts of a run, measures of stations and floors, and fields of plans."""

from __future__ import annotations

import difflib
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Literal

from app.jobs.states import State
from app.models import LONGEST_VALUE
from app.runs.plan_fields import plan_field
from app.runs.values import LARGEST, PLAN
from rths_engine.foundation.errors import Issue, RthsError
from rths_engine.planning.kinds_of_test import TESTS
from rths_engine.planning.plan import MOST_STATIONS
from rths_engine.results.measure import FloorMeasure, Measure, RunMeasure, StationMeasure
from rths_engine.results.measures import MEASURES, of

Kind = Literal["text", "number", "time", "tags", "flag"]
Choices = tuple[tuple[str, str], ...]
NEAR = 3  # names offered for a column that does not exist
MOST_FLOORS = 100


@dataclass(frozen=True, slots=True)
class Column:
    """A column of the run table.

    `key` names it in addresses. A number is shown in `unit`; in the database it is `factor` times as large. `stored` tells that
    the value is a column of the table of runs; otherwise it stands in `RunValue` under the path `key`. `choices` are the values
    of a choice and their names for people.
    """

    key: str
    label: str
    group: str
    kind: Kind
    unit: str = ""
    factor: float = 1.0
    help: str = ""
    choices: Choices = ()
    stored: bool = True

    @property
    def heading(self) -> str:
        return f"{self.label}, {self.unit}" if self.unit else self.label


def _test_column(one: RunMeasure) -> Column:
    return Column(one.key, one.label, "Measures of the whole test", "number", one.shown_label, help=one.meaning)


# columns of the table of runs, by key
FACTS: dict[str, Column] = {
    one.key: one
    for one in (
        Column("number", "Run", "Run", "number", help="number of the run"),
        Column("name", "Name", "Run", "text"),
        Column("state", "Status", "Run", "text", choices=tuple((state.value, state.value) for state in State)),
        Column("tags", "Tags", "Run", "tags"),
        Column("notes", "Notes", "Run", "text"),
        Column("test", "Kind of test", "Run", "text", choices=tuple(TESTS.items())),
        Column("template", "Template", "Run", "text"),
        Column("submitted_by", "Submitted by", "Run", "text"),
        Column("submitted_at", "Submitted", "Times", "time"),
        Column("started_at", "Started", "Times", "time"),
        Column("finished_at", "Ended", "Times", "time"),
        Column("duration_s", "Planned duration", "Times", "number", "s"),
        Column("simulated_s", "Simulated time", "Times", "number", "s"),
        Column("elapsed_s", "Elapsed time", "Times", "number", "s"),
        Column("reason", "Reason for the end", "Run", "text", help="for a trip: station, limit and value"),
        Column("attempt", "Attempts", "Run", "number"),
        Column("worker", "Worker", "Run", "text"),
        Column("seed", "Seed", "Run", "number"),
        Column("digest", "Plan digest", "Run", "text"),
        Column("code_version", "Code version", "Run", "text"),
        Column("recording_size", "Size of the recording", "Run", "number", "MB", 1e6),
        Column("archived", "Archived", "Run", "flag", choices=(("yes", "yes"), ("no", "no"))),
        *(_test_column(one) for one in of(RunMeasure)),
    )
}
LISTED = tuple(one.key if one.scope == "run" else f"{one.key}:{LARGEST}" for one in MEASURES if one.listed)
DEFAULT = ("number", "name", "state", "tags", *LISTED, "submitted_by", "submitted_at")
ALIASES = {"tag": "tags", "by": "submitted_by", "status": "state"}


def column(key: str, stations: int = MOST_STATIONS) -> Column | None:
    """The column named `key`, or None. `stations` is the largest number of a station of any run."""
    key = ALIASES.get(key, key)
    if key in FACTS:
        return FACTS[key]
    if key.startswith(PLAN) and len(key) <= LONGEST_VALUE:
        return _planned(key)
    name, _, number = key.partition(":")
    measure = {one.key: one for one in (*of(StationMeasure), *of(FloorMeasure))}.get(name)
    if measure is None or not (number == LARGEST or _counts(number, stations if measure.scope == "station" else MOST_FLOORS)):
        return None
    return _measured(measure, number)


def known(key: str, where: str, stored: Iterable[str], stations: int = MOST_STATIONS) -> Column:
    """The column named `key`. Raises RthsError with near matches. `stored` are the paths of values that runs have."""
    found = column(key, stations)
    if found:
        return found
    measures = [f"{one.key}:{which}" for one in (*of(StationMeasure), *of(FloorMeasure)) for which in (LARGEST, 1, 2)]
    if key.partition(":")[0] in {one.partition(":")[0] for one in measures}:
        most = f"needs a station number from 1 to {stations} after the colon, or {LARGEST}; no stored run has more stations"
        raise RthsError(Issue(where, most, key, f"try {key.partition(':')[0]}:1"))
    near = difflib.get_close_matches(key, [*FACTS, *ALIASES, *measures, *stored], NEAR, 0.5)
    fix = f"try {' or '.join(near)}" if near else "GET /api/v1/runs/columns lists the columns"
    raise RthsError(Issue(where, "is not a column of the run table", key, fix))


def _counts(text: str, most: int) -> bool:
    return text.isascii() and text.isdecimal() and text[0] != "0" and int(text[:9]) <= most


def _measured(one: Measure, which: str) -> Column:
    each = {"station": "station", "floor": "floor"}[one.scope]
    named = "largest" if which == LARGEST else f"{each} {which}"
    label = f"{one.label}, {named}"
    group = f"Measures of {each}s"
    return Column(f"{one.key}:{which}", label, group, "number", one.shown_label, help=one.meaning, stored=False)


def _planned(key: str) -> Column | None:
    field = plan_field(key.removeprefix(PLAN))
    if field is None:
        return None
    label = f"{field.within}: {field.label}" if field.within else field.label
    kind: Kind = "number" if field.numeric else "text"
    return Column(key, label, "Plan", kind, field.unit, field.factor, field.help, field.choices, stored=False)
