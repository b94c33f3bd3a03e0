"""SQL of the run table: the cells of a page. Never commits."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import sqlalchemy as sa
from sqlalchemy.orm import Session

from app.models import Run, ValuePath
from app.runs.columns import Column
from app.runs.expressions import Condition
from app.runs.query import RunQuery, path_ids, values_of
from app.runs.shelves import Shelf, on_shelf, searched

ALWAYS = ("number", "id", "name", "state")
TOGETHER = 400  # runs read by one statement: bound parameters are limited


class TableRows:
    """Reads pages of the run table."""

    def __init__(self, session: Session):
        self.session = session

    def paths(self) -> list[str]:
        """The paths at which runs have values."""
        return list(self.session.scalars(sa.select(ValuePath.path)))

    def query(self, filters: Sequence[tuple[Column, Condition]], text: str, shelf: Shelf) -> RunQuery:
        return RunQuery(self.session, on_shelf(shelf), searched(text), filters)

    def read(
        self, numbers: Sequence[int], facts: Sequence[str], paths: Sequence[str]
    ) -> tuple[dict[int, dict[str, Any]], dict[tuple[int, str], float | str]]:
        """Facts of runs by number, and values by number and path."""
        names = list(dict.fromkeys([*ALWAYS, *facts]))
        ids = path_ids(self.session, paths)
        found: dict[int, dict[str, Any]] = {}
        values: dict[tuple[int, str], float | str] = {}
        for first in range(0, len(numbers), TOGETHER):
            part = numbers[first : first + TOGETHER]
            query = sa.select(*(getattr(Run, name) for name in names)).where(Run.number.in_(part))
            found |= {row["number"]: dict(row) for row in self.session.execute(query).mappings()}
            values |= values_of(self.session, part, ids)
        return found, values
