"""SQL of runs. Never commits."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from datetime import datetime

import sqlalchemy as sa
from sqlalchemy.orm import Session

from app.jobs.repository import JobRepository
from app.jobs.states import State
from app.models import LibraryPlan, PlanVersion, Run, RunStation
from app.runs import values
from app.runs.columns import known
from app.runs.conditions import contains
from app.runs.pages import Order
from app.runs.query import RunQuery
from app.runs.shelves import Shelf, on_shelf, searched
from rths_engine.planning.plan import MOST_STATIONS

assert values  # the import makes values follow from runs


@dataclass(frozen=True, slots=True)
class Filter:
    """The filter of a list of runs."""

    states: tuple[State, ...] = ()
    text: str = ""
    submitted_by: str = ""
    template: str = ""
    since: datetime | None = None
    until: datetime | None = None
    shelf: Shelf = Shelf.SHOWN


@dataclass(frozen=True, slots=True)
class Page:
    """Order and page of a list."""

    sort: str = "number"
    descending: bool = True
    limit: int = 50
    offset: int = 0


class RunRepository(JobRepository[Run]):
    """SQL of runs. Never commits."""

    def __init__(self, session: Session):
        super().__init__(session, Run)

    def listed(self, wanted: Filter, page: Page) -> tuple[list[Run], int]:
        """The runs of a page, and the number of all runs that the filter keeps. Raises RthsError for an unknown column."""
        query = RunQuery(self.session, on_shelf(wanted.shelf), self._conditions(wanted))
        column = known(page.sort, "sort", (), self.most_stations() or MOST_STATIONS)
        found = query.page(Order(column, page.descending), page.limit, page.offset)
        runs = {run.number: run for run in self.session.scalars(sa.select(Run).where(Run.number.in_(found.numbers)))}
        return [runs[number] for number in found.numbers], found.total if found.exact else query.count()

    def most_stations(self) -> int:
        """Largest station number of all runs with measures; 0 before the first test has ended."""
        return self.session.scalar(sa.select(sa.func.max(RunStation.number))) or 0

    def in_states(self, *states: State) -> list[Run]:
        query = sa.select(Run).where(Run.state.in_(states)).order_by(Run.number)
        return list(self.session.scalars(query))

    def version(self, library_id: str, version: int) -> tuple[LibraryPlan, PlanVersion] | None:
        """A plan in the library and one of its versions; None where there is none."""
        query = sa.select(LibraryPlan, PlanVersion).join(PlanVersion, LibraryPlan.number == PlanVersion.plan_number)
        found = self.session.execute(query.where(LibraryPlan.id == library_id, PlanVersion.number == version)).first()
        return None if found is None else (found[0], found[1])

    @staticmethod
    def _conditions(wanted: Filter) -> Iterator[sa.ColumnElement[bool]]:
        yield from searched(wanted.text)
        if wanted.states:
            yield Run.state.in_(wanted.states)
        if wanted.submitted_by:
            yield contains(Run.submitted_by, wanted.submitted_by)
        if wanted.template:
            yield Run.template == wanted.template
        if wanted.since:
            yield Run.submitted_at >= wanted.since
        if wanted.until:
            yield Run.submitted_at < wanted.until
