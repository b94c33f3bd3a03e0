"""SQL of runs. Never commits."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime

import sqlalchemy as sa
from sqlalchemy.orm import Session

from app.jobs.repository import JobRepository
from app.jobs.states import State
from app.models import LibraryPlan, PlanVersion, Run, RunStation
from app.runs import values
from rths_engine.results.measure import RunMeasure, StationMeasure
from rths_engine.results.measures import of

assert values  # the import makes values follow from runs
SORTS = {
    "number": Run.number,
    "name": Run.name,
    "state": Run.state,
    "submitted_by": Run.submitted_by,
    "submitted_at": Run.submitted_at,
    "finished_at": Run.finished_at,
    "elapsed_s": Run.elapsed_s,
    "simulated_s": Run.simulated_s,
    "template": Run.template,
    **{one.key: getattr(Run, one.key) for one in of(RunMeasure)},
}
MEASURES = tuple(one.key for one in of(StationMeasure))


@dataclass(frozen=True, slots=True)
class Filter:
    """The filter of a list of runs."""

    states: tuple[State, ...] = ()
    text: str = ""
    submitted_by: str = ""
    template: str = ""
    since: datetime | None = None
    until: datetime | None = None


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
        query = self._filtered(wanted)
        total = self.session.scalar(sa.select(sa.func.count()).select_from(query.subquery())) or 0
        column, _, station = page.sort.partition(":")
        order = self._measure(column, int(station)) if station else SORTS[column]
        ordered = (order.desc() if page.descending else order.asc()).nulls_last()
        query = query.order_by(ordered, Run.number.desc())
        return list(self.session.scalars(query.limit(page.limit).offset(page.offset))), total

    def most_stations(self) -> int:
        """Largest station number of all runs with measures; 0 before the first test has ended."""
        return self.session.scalar(sa.select(sa.func.max(RunStation.number))) or 0

    def in_states(self, *states: State) -> list[Run]:
        query = sa.select(Run).where(Run.state.in_(states)).order_by(Run.number)
        return list(self.session.scalars(query))

    def has_version(self, library_id: str, version: int) -> bool:
        """Whether the library has this version of a plan."""
        query = sa.select(PlanVersion.number).join(LibraryPlan, LibraryPlan.number == PlanVersion.plan_number)
        return self.session.scalar(query.where(LibraryPlan.id == library_id, PlanVersion.number == version)) is not None

    def _filtered(self, wanted: Filter) -> sa.Select[Run]:
        query = sa.select(Run).where(Run.archived.is_(False), Run.deleted_at.is_(None))
        if wanted.states:
            query = query.where(Run.state.in_(wanted.states))
        if wanted.text:
            like = f"%{_escaped(wanted.text)}%"
            query = query.where(Run.name.ilike(like, escape="\\") | Run.id.ilike(like, escape="\\"))
        if wanted.submitted_by:
            query = query.where(Run.submitted_by.ilike(f"%{_escaped(wanted.submitted_by)}%", escape="\\"))
        if wanted.template:
            query = query.where(Run.template == wanted.template)
        if wanted.since:
            query = query.where(Run.submitted_at >= wanted.since)
        if wanted.until:
            query = query.where(Run.submitted_at < wanted.until)
        return query

    @staticmethod
    def _measure(name: str, station: int) -> sa.ScalarSelect[float]:
        column = getattr(RunStation, name)
        return sa.select(column).where(RunStation.run_number == Run.number, RunStation.number == station).scalar_subquery()


def _escaped(text: str) -> str:
    return text.replace("\\", "\\\\").replace("%", "\\%").replace("_", "\\_")
