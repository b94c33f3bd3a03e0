"""SQL of a page of all runs of a shelf, in the order of one column, however far down. Never commits.

A page is the part from `offset` on of the runs with a value, in the order of the value and then of the number, followed by the
runs without a value in the order of their numbers. Each part is a walk along one index that holds all that the walk looks at:

- a column of the table of runs has the index `(column, number, archived, deleted_at)`;
- a value has that of `RunValue`; the few runs that the shelf hides, or the few that it shows, are a set of numbers.

So the number of runs counts, and not their size: docs/decisions/0073.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import sqlalchemy as sa
from sqlalchemy.orm import Session

from app.models import SORTED, Run, RunValue
from app.runs.columns import Column
from app.runs.conditions import stored

Sql = sa.ColumnElement[bool]
SCANNED = Run.share >= 0.0
"""A condition that every run meets and no index can answer.

As the first condition it makes SQLite read the rows in their order. Otherwise SQLite walks along any index that holds what
hides a run, and looks up nearly every row: 190 ms instead of 40.
"""
EMPTY = ("tags", "notes")
"""Columns whose value is an empty text where there is none."""


@dataclass(frozen=True, slots=True)
class Order:
    """The order of a list. Runs without a value come last; runs with equal values are in the order of their numbers."""

    column: Column
    descending: bool = True


def page(session: Session, shelf: Sequence[Sql], order: Order, path: int | None, limit: int, offset: int) -> list[int]:
    """The numbers of the runs of a page. `path` is the id of the path of a value; None where no run has a value."""
    if order.column.key == "number":
        return _walk(session, order, Run.number, sa.select(Run.number).where(*shelf), [], limit, offset)
    if order.column.stored:
        with_value, without = _facts(shelf, order.column)
        key, number = stored(order.column), Run.number
    else:
        with_value, without = _values(shelf, order.column, path or 0)
        key, number = _value(order.column), RunValue.run_number
    found = _walk(session, order, number, with_value, [key], limit, offset)
    if len(found) == limit:
        return found
    passed = 0 if found or not offset else offset - _count(session, with_value)
    return found + _walk(session, order, Run.number, without, [], limit - len(found), passed)


def _facts(shelf: Sequence[Sql], column: Column) -> tuple[sa.Select[Any], sa.Select[Any]]:
    """The runs with and without a value in a column of the table of runs."""
    key, chosen = stored(column), sa.select(Run.number).where(*shelf)
    if column.key not in SORTED:
        chosen = sa.select(Run.number).where(SCANNED, *shelf)
    if column.key in EMPTY:
        return chosen.where(key > ""), chosen.where(key == "")
    return chosen.where(key.is_not(None)), chosen.where(key.is_(None))


def _values(shelf: Sequence[Sql], column: Column, path: int) -> tuple[sa.Select[Any], sa.Select[Any]]:
    """The runs with and without a value of the path of a column."""
    on_path = (RunValue.path_id == path) & _value(column).is_not(None)
    hidden = sa.select(Run.number).where(sa.not_(sa.and_(*shelf)))
    with_value = sa.select(RunValue.run_number).where(on_path, RunValue.run_number.not_in(hidden))
    return with_value, sa.select(Run.number).where(*shelf, ~sa.exists().where(on_path, RunValue.run_number == Run.number))


def _value(column: Column) -> Any:
    return RunValue.number if column.kind == "number" else RunValue.text


def _walk(
    session: Session, order: Order, number: Any, runs: sa.Select[Any], keys: list[Any], limit: int, offset: int
) -> list[int]:
    by = [one.desc() if order.descending else one.asc() for one in (*keys, number)]
    return list(session.scalars(runs.order_by(*by).limit(limit).offset(offset)))


def _count(session: Session, runs: sa.Select[Any]) -> int:
    return session.scalar(sa.select(sa.func.count()).select_from(runs.subquery())) or 0
