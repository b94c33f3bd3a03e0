"""Conditions of a filter as SQL: on a column of the table of runs, or on the number or text of a value."""

from __future__ import annotations

import operator
import re
from collections.abc import Callable
from datetime import UTC, datetime, timedelta
from typing import Any

import sqlalchemy as sa

from app.models import Run
from app.runs.columns import Column
from app.runs.expressions import Condition
from rths_engine.foundation import units
from rths_engine.foundation.errors import Issue, RthsError

SAME = 1e-9  # relative difference of numbers that are equal up to their conversion to another unit
COMPARE: dict[str, Callable[[Any, Any], Any]] = {"<": operator.lt, "<=": operator.le, ">": operator.gt, ">=": operator.ge}
_AGO = re.compile(r"-(\d{1,5}) ?(min|h|d)")
_DAY = re.compile(r"\d{4}-\d{2}-\d{2}")
_MINUTES = {"min": 1, "h": 60, "d": 1440}
FLAGS = {"yes": True, "no": False}

Sql = sa.ColumnElement[bool]


def stored(column: Column) -> Any:
    """The attribute of the table of runs that a column shows; tags as text."""
    attribute = getattr(Run, column.key)
    return sa.type_coerce(attribute, sa.Text) if column.kind == "tags" else attribute


def matches(column: Column, condition: Condition, value: Any) -> Sql:
    """Whether `value` equals (`=`, `!=`), contains (`~`, `!~`) or compares to what the condition names, without negation.

    Raises RthsError for a value that is not of the kind of the column.
    """
    if condition.operator in ("~", "!~"):
        if column.kind not in ("text", "tags"):
            raise RthsError(Issue("where", f"{column.label} is not a text: ~ is not allowed", condition.text, "use = < or >"))
        return contains(value, condition.values[0])
    if condition.operator in COMPARE:
        return _compares(column, condition, value)
    found: list[Sql] = [_equals(column, condition, value, text) for text in condition.values]
    return sa.or_(*found)


def missing(column: Column, value: Any) -> Sql:
    """Whether a run has no value in a column of the table of runs."""
    none: Sql = value.is_(None)
    return sa.or_(none, value == "") if column.kind in ("text", "tags") else none


def contains(value: Any, text: str) -> Sql:
    """Whether a text contains another one, in any case of its letters."""
    found: Sql = value.ilike(f"%{escaped(text)}%", escape="\\")
    return found


def escaped(text: str) -> str:
    """Text in which LIKE takes no character for a wildcard."""
    return text.replace("\\", "\\\\").replace("%", "\\%").replace("_", "\\_")


def _compares(column: Column, condition: Condition, value: Any) -> Sql:
    text, compare = condition.values[0], COMPARE[condition.operator]
    if column.kind in ("tags", "flag"):
        raise RthsError(Issue("where", f"{column.label} has no order", condition.text, "use = or !="))
    if column.kind == "number":
        return sa.and_(compare(value, _number(column, text)))
    if column.kind == "time":
        begin, end = _times(text)
        return sa.and_(compare(value, end if condition.operator in ("<=", ">") else begin))
    return sa.and_(compare(value, text))


def _equals(column: Column, condition: Condition, value: Any, text: str) -> Sql:
    if column.kind == "number":
        number = _number(column, text)
        slack = abs(number) * SAME
        return sa.and_(value.between(number - slack, number + slack))
    if column.kind == "time":
        begin, end = _times(text)
        return sa.and_(value >= begin, value <= end)
    if column.kind == "tags":
        return contains(value, f"|{text}|")
    if column.kind == "flag":
        if text not in FLAGS:
            raise RthsError(Issue("where", "is neither yes nor no", condition.text))
        return sa.and_(value.is_(FLAGS[text]))
    if column.choices and text not in dict(column.choices):
        choices = ", ".join(one for one, _ in column.choices)
        raise RthsError(Issue("where", f"{column.label} has no value '{text}'", condition.text, f"choose one of {choices}"))
    return sa.and_(value == text)


def _number(column: Column, text: str) -> float:
    """A number in the unit of the column, or with a unit of its own, as stored."""
    try:
        number = float(text)
    except ValueError:
        if not column.unit:
            raise RthsError(Issue("where", f"{column.label} needs a number", text)) from None
        shown = units.named(column.unit) or column.unit
        try:
            number = units.from_si(units.parse(text, shown), shown)
        except RthsError as error:
            problem = f"{column.label} {error.issues[0].problem}"
            raise RthsError(Issue("where", problem, text, error.issues[0].fix)) from None
    if number != number or abs(number) == float("inf"):
        raise RthsError(Issue("where", f"{column.label} needs a finite number", text))
    return number * column.factor


def _times(text: str) -> tuple[datetime, datetime]:
    """The first and the last instant that a text names: a day, a time, or an age such as `-7 d`. UTC without a time zone."""
    ago = _AGO.fullmatch(text)
    if ago:
        moment = datetime.now(UTC) - timedelta(minutes=int(ago[1]) * _MINUTES[ago[2]])
        return moment, moment
    try:
        moment = datetime.fromisoformat(text)
        moment = moment.replace(tzinfo=UTC) if moment.tzinfo is None else moment.astimezone(UTC)
        whole = timedelta(days=1) if _DAY.fullmatch(text) else timedelta(0)
        return moment, moment + whole - (timedelta(microseconds=1) if whole else timedelta(0))
    except (ValueError, OverflowError):
        fix = "write a date such as 2026-11-23, a time such as 2026-11-23T14:00, or an age such as -7d"
        raise RthsError(Issue("where", "is not a valid date", text, fix)) from None
