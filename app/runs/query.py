"""SQL of the run table: which runs a filter keeps, in which order, and how many. Never commits.

A filter or an order by a value (a plan field, a measure of a station) reads `RunValue`, of which one path is a compact column
of all runs. The way to a page depends on how many runs the filter keeps:

- Few: one query finds them, sorts them and so counts them. A condition on a value that few runs meet becomes a set of runs,
  from which the query starts. Any other condition is checked run by run.
- Many, in the order of values: walk along the values of the column and keep the runs that the filter keeps, until the page is
  full. A walk that is not done after BUDGET values is given up for a scan.
- Many, else: scan all runs, join the value to sort by, and sort. The time is bounded by the number of runs.
- All runs of a shelf: walk along the index of the column, without a look at the runs themselves: `app/runs/pages.py`.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import sqlalchemy as sa
from sqlalchemy.orm import Session, aliased

from app.models import SORTED, Run, RunValue, ValuePath
from app.runs import pages
from app.runs.columns import Column
from app.runs.conditions import matches, missing, stored
from app.runs.expressions import Condition
from app.runs.pages import EMPTY, SCANNED, Order

# chosen; docs/decisions/0046 has the measurements
FEW = 5_000  # runs that a filter keeps and that are counted; a list says when there are more
BUDGET = 5_000  # values that a walk reads before it leaves the page to a scan
NEGATED = ("!=", "!~")

Sql = sa.ColumnElement[bool]


@dataclass(frozen=True, slots=True)
class Found:
    """The numbers of the runs of a page, how many runs the filter keeps, and whether this number is exact or the least."""

    numbers: list[int]
    total: int
    exact: bool = True


class RunQuery:
    """Finds runs by a filter. `shelf` and `where` are conditions on the table of runs; `filters` are conditions on columns."""

    def __init__(
        self, session: Session, shelf: Sequence[Sql], where: Iterable[Sql], filters: Sequence[tuple[Column, Condition]] = ()
    ):
        self.session = session
        self.ids = path_ids(session, [column.key for column, _ in filters if not column.stored])
        conditions = [*where, *(_on_run(column, condition) for column, condition in filters if column.stored)]
        self.reads_rows = bool(conditions)  # else indexes hold all that a filter looks at
        conditions += [self._on_value(column, condition) for column, condition in filters if not column.stored]
        self.filters, self.shelf = filters, list(shelf)
        self.filtered, self.where = bool(conditions), [*shelf, *conditions]

    def page(self, order: Order, limit: int, offset: int = 0) -> Found:
        """A page of the runs that the filter keeps, and their number."""
        path = None if order.column.stored else path_ids(self.session, [order.column.key]).get(order.column.key)
        if not self.filtered:
            total = self.count()
            return Found(pages.page(self.session, self.shelf, order, path, limit, offset, total), total)
        kept = self._kept(order, path)
        few = self._sorted(order, kept.limit(FEW + 1))
        if len(few) <= FEW:
            return Found(few[offset : offset + limit], len(few))
        numbers = self._walk(order, path, limit, offset) if path is not None and offset + limit <= BUDGET else []
        if len(numbers) < limit:
            numbers = self._sorted(order, kept, limit, offset)
        return Found(numbers, FEW, exact=False)

    def count(self) -> int:
        """The number of all runs that the filter keeps."""
        return self.session.scalar(sa.select(sa.func.count()).select_from(Run).where(*self.where)) or 0

    def _kept(self, order: Order, path: int | None) -> sa.Select[Any]:
        """The runs that the filter keeps: their numbers, and the keys to sort by. Reads no rows where indexes hold all."""
        indexed = not order.column.stored or order.column.key in ("number", *SORTED)
        where = self.where if indexed and not self.reads_rows else [SCANNED, *self.where]
        if order.column.stored:
            return sa.select(Run.number, _sort_key(order.column).label("key")).where(*where)
        value = aliased(RunValue)
        at = (value.path_id == (path or 0)) & (value.run_number == Run.number)
        return sa.select(Run.number, _key(value, order.column).label("key")).outerjoin(value, at).where(*where)

    def _sorted(self, order: Order, kept: sa.Select[Any], limit: int | None = None, offset: int = 0) -> list[int]:
        within = kept.subquery()
        by = _by(order, within.c.key, within.c.number)
        return list(self.session.scalars(sa.select(within.c.number).order_by(*by).limit(limit).offset(offset)))

    def _walk(self, order: Order, path: int, limit: int, offset: int) -> list[int]:
        """The page along the values of a column, shorter where BUDGET values do not fill it."""
        key = _key(RunValue, order.column)
        by = [one.desc() if order.descending else one.asc() for one in (key, RunValue.run_number)]
        values = sa.select(RunValue.run_number, key.label("key")).where(RunValue.path_id == path, key.is_not(None))
        for column, condition in self.filters:  # conditions on the same column bound the walk
            if column.key == order.column.key and condition.values and condition.operator not in NEGATED:
                values = values.where(matches(column, condition, key))
        first = values.order_by(*by).limit(BUDGET).subquery()
        by = [one.desc() if order.descending else one.asc() for one in (first.c.key, first.c.run_number)]
        query = sa.select(Run.number).join_from(first, Run, Run.number == first.c.run_number).where(*self.where)
        return list(self.session.scalars(query.order_by(*by).limit(limit).offset(offset)))

    def _on_value(self, column: Column, condition: Condition) -> Sql:
        """A condition on a value. With a negation, runs without the value are kept too."""
        negated = condition.operator in NEGATED
        value = aliased(RunValue)
        met = [value.path_id == self.ids.get(column.key, 0)]
        if condition.values:
            met.append(matches(column, condition, _key(value, column)))
        else:
            negated = not negated  # `=` without a value keeps the runs that have none
        if not negated and self._met_by_few(value, met):
            return Run.number.in_(sa.select(value.run_number).where(*met))
        exists = sa.exists().where(*met, value.run_number == Run.number)
        return ~exists if negated else exists

    def _met_by_few(self, value: Any, met: Sequence[Sql]) -> bool:
        within = sa.select(value.run_number).where(*met).limit(FEW + 1).subquery()
        return (self.session.scalar(sa.select(sa.func.count()).select_from(within)) or 0) <= FEW


def path_ids(session: Session, paths: Sequence[str]) -> dict[str, int]:
    """The ids of those paths at which runs have values."""
    if not paths:
        return {}
    query = sa.select(ValuePath.path, ValuePath.id).where(ValuePath.path.in_(paths))
    return {path: number for path, number in session.execute(query)}


def values_of(session: Session, numbers: Sequence[int], ids: Mapping[str, int]) -> dict[tuple[int, str], float | str]:
    """The values of runs at paths, by number of the run and path."""
    if not ids or not numbers:
        return {}
    names = {number: path for path, number in ids.items()}
    query = sa.select(RunValue.path_id, RunValue.run_number, RunValue.number, RunValue.text)
    found = session.execute(query.where(RunValue.path_id.in_(names), RunValue.run_number.in_(numbers)))
    return {(run, names[path]): (text or "") if number is None else number for path, run, number, text in found}


def _on_run(column: Column, condition: Condition) -> Sql:
    value = stored(column)
    if not condition.values:
        none = missing(column, value)
        return none if condition.operator == "=" else sa.not_(none)
    met = matches(column, condition, value)
    return sa.or_(missing(column, value), sa.not_(met)) if condition.operator in NEGATED else met


def _key(value: Any, column: Column) -> Any:
    return value.number if column.kind == "number" else value.text


def _sort_key(column: Column) -> Any:
    return sa.func.nullif(stored(column), "") if column.key in EMPTY else stored(column)


def _by(order: Order, key: Any, number: Any) -> list[Any]:
    """Sort by the key and then by the number; missing keys come last."""
    first = [] if order.column.key == "number" else [(key.desc() if order.descending else key.asc()).nulls_last()]
    return [*first, number.desc() if order.descending else number.asc()]
