"""SQL of a page of all runs of a shelf, in the order of one column, however far down. Never commits.

The order has two parts: the runs with a value, in the order of the value and then of the number, and after them the runs
without a value, in the order of their numbers. Each part is a walk along one index that holds all that the walk looks at:

- a column of the table of runs has the index `(column, number, archived, deleted_at)`;
- a value has that of `RunValue`; the few runs that the shelf hides, or the few that it shows, are a set of numbers.

A walk begins at the nearer end of its part, so it passes half of the part at most. The number of runs counts, and not their
size: docs/decisions/0073, 0081.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import sqlalchemy as sa
from sqlalchemy.orm import Session

from app.models import LONG_TEXTS, Run, RunValue, is_long, is_short
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


@dataclass(frozen=True, slots=True)
class Part:
    """A part of an order: the runs, the keys by which they are sorted, and, for the first of two parts, a way to count them."""

    runs: sa.Select[Any]
    by: Sequence[Any]
    count: Callable[[], int] | None = None


def page(
    session: Session, shelf: Sequence[Sql], order: Order, path: int | None, limit: int, offset: int, total: int
) -> list[int]:
    """The numbers of the runs of a page. `total` is the number of all runs of the shelf.

    `path` is the id of the path of a value; None where no run has a value.
    """
    first, *second = _parts(session, shelf, order, path or 0, total)
    limit = min(limit, total - offset)
    size, rest = total, total  # the first page needs no count: each part has this many runs at most
    if first.count and offset:
        size = first.count()
        rest = total - size
    found = _walk(session, first, order.descending, limit, offset, size)
    for part in second:
        found += _walk(session, part, order.descending, limit - len(found), max(0, offset - size), rest)
    return found


def _walk(session: Session, part: Part, descending: bool, limit: int, offset: int, size: int) -> list[int]:
    """The numbers from `offset` on of a part that has `size` runs, from its start or backwards from its end."""
    limit = min(limit, size - offset)
    if limit <= 0:
        return []
    after = size - offset - limit  # runs that follow
    backwards = after < offset
    by = [key.desc() if descending != backwards else key.asc() for key in part.by]
    found = list(session.scalars(part.runs.order_by(*by).limit(limit).offset(after if backwards else offset)))
    return found[::-1] if backwards else found


def _parts(session: Session, shelf: Sequence[Sql], order: Order, path: int, total: int) -> list[Part]:
    """The runs with a value and the runs without; or archived runs and others; or all runs, where one walk finds them."""
    column, all_runs = order.column, sa.select(Run.number).where(*shelf)
    if not column.stored:
        return _by_value(session, shelf, column, path)
    if column.key == "number":
        return [Part(all_runs, [Run.number])]
    if column.key == "archived":
        yes, no = (all_runs.where(Run.archived.is_(flag)) for flag in (order.descending, not order.descending))
        return [Part(yes, [Run.number], lambda: _count(session, yes)), Part(no, [Run.number])]
    key = stored(column)
    if column.key in LONG_TEXTS:
        if _has_long(session, column.key):
            key = sa.func.nullif(key, "") if column.key in EMPTY else key
            last = key.is_not(None) if order.descending else key.is_(None)
            return [Part(sa.select(Run.number).where(SCANNED, *shelf), [last, key, Run.number])]
        all_runs = all_runs.where(sa.text(is_short(column.key)))
    with_value = all_runs.where(key > "" if column.key in EMPTY else key.is_not(None))
    without = all_runs.where(key == "" if column.key in EMPTY else key.is_(None))
    return [Part(with_value, [key, Run.number], lambda: total - _count(session, without)), Part(without, [Run.number])]


def _by_value(session: Session, shelf: Sequence[Sql], column: Column, path: int) -> list[Part]:
    """The runs with and without a value of the path of a column."""
    key = RunValue.number if column.kind == "number" else RunValue.text
    on_path = (RunValue.path_id == path) & key.is_not(None)
    has_value = sa.exists().where(on_path, RunValue.run_number == Run.number)
    hidden = sa.select(Run.number).where(sa.not_(sa.and_(*shelf)))
    shown = sa.select(Run.number).where(*shelf)

    def count() -> int:
        if session.get_bind().dialect.name == "postgresql":  # 22 ms for 100 000 values instead of 40; SQLite 22 instead of 8
            return _count(session, with_value)
        everything = sa.select(RunValue.run_number).where(on_path)
        return _count(session, everything) - _count(session, hidden.where(has_value))

    with_value = sa.select(RunValue.run_number).where(on_path, RunValue.run_number.not_in(hidden))
    return [Part(with_value, [key, RunValue.run_number], count), Part(shown.where(~has_value), [Run.number])]


def _has_long(session: Session, column: str) -> bool:
    """Whether a text of any run is too long for the index of the column."""
    return session.scalar(sa.select(Run.number).where(sa.text(is_long(column))).limit(1)) is not None


def _count(session: Session, runs: sa.Select[Any]) -> int:
    return session.scalar(sa.select(sa.func.count()).select_from(runs.subquery())) or 0
