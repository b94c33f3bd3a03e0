"""Rules of the run table: which columns there are, and a page of them. No SQL, no HTTP."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any

from sqlalchemy.orm import Session

from app.runs import expressions
from app.runs.columns import DEFAULT, FACTS, Column, column, known
from app.runs.pages import Order
from app.runs.query import RunQuery
from app.runs.shelves import Shelf
from app.runs.table_rows import TableRows
from app.runs.table_schemas import Cell, Choice, ColumnList, ColumnOut, RowOut, RunTable
from rths_engine.foundation.errors import Issue, RthsError

MOST_COLUMNS = 40
EXPORTED = 100_000  # rows of one CSV file
PART = 1000  # rows of a CSV file read together


@dataclass(frozen=True, slots=True)
class Wanted:
    """Columns, filter and order of a run table, by their keys."""

    columns: Sequence[str] = ()
    where: str = ""
    text: str = ""
    sort: str = "number"
    descending: bool = True
    shelf: Shelf = field(default=Shelf.SHOWN)


class RunTableService:
    """Pages of the run table. No SQL, no HTTP."""

    def __init__(self, session: Session):
        self.rows = TableRows(session)

    def columns(self) -> ColumnList:
        """Every column of which a run has a value, the facts of runs first, then measures, then plan fields by path."""
        stored = [found for path in self.rows.paths() if (found := column(path))]
        return ColumnList(columns=[_out(one) for one in (*FACTS.values(), *sorted(stored, key=_place))], default=list(DEFAULT))

    def page(self, wanted: Wanted, limit: int, offset: int) -> RunTable:
        """A page of the table. Raises RthsError for a column that does not exist and for a filter that is not valid."""
        columns = self._known(wanted.columns or DEFAULT)
        query, order = self._query(wanted)
        found = query.page(order, limit, offset)
        rows = list(self._rows(columns, found.numbers))
        return RunTable(columns=[_out(one) for one in columns], rows=rows, total=found.total, exact=found.exact)

    def export(self, wanted: Wanted) -> Iterator[list[Any]]:
        """The header and the rows of the whole table, at most EXPORTED rows. Raises RthsError like `page`."""
        columns = self._known(wanted.columns or DEFAULT)
        query, order = self._query(wanted)
        numbers = query.page(order, EXPORTED).numbers
        yield [one.heading for one in columns]
        for first in range(0, len(numbers), PART):
            for row in self._rows(columns, numbers[first : first + PART]):
                yield row.cells

    def _query(self, wanted: Wanted) -> tuple[RunQuery, Order]:
        filters = [(self._one(one.key, "where"), one) for one in expressions.read(wanted.where)]
        query = self.rows.query(filters, wanted.text.strip(), wanted.shelf)
        return query, Order(self._one(wanted.sort or "number", "sort"), wanted.descending)

    def _known(self, keys: Sequence[str]) -> list[Column]:
        if len(keys) > MOST_COLUMNS:
            raise RthsError(Issue("columns", f"has {len(keys)} columns; the limit is {MOST_COLUMNS} columns"))
        return [self._one(key, "columns") for key in dict.fromkeys(keys)]

    def _one(self, key: str, where: str) -> Column:
        found = column(key)
        return found or known(key, where, self.rows.paths())

    def _rows(self, columns: Sequence[Column], numbers: Sequence[int]) -> Iterator[RowOut]:
        facts = [one.key for one in columns if one.stored]
        found, values = self.rows.read(numbers, facts, [one.key for one in columns if not one.stored])
        for number in numbers:
            if number in found:
                run = found[number]
                cells = [_cell(one, run[one.key] if one.stored else values.get((number, one.key))) for one in columns]
                yield RowOut(id=run["id"], number=number, name=run["name"], state=run["state"], cells=cells)


def _cell(column: Column, value: Any) -> Cell:
    if value is None or value == "":
        return None
    if column.kind == "time":
        return str(value.isoformat())
    if column.kind == "number" and column.factor != 1.0:
        return float(f"{value / column.factor:.12g}")  # without the last digits, which the conversion of the unit makes
    found: Cell = value
    return found


def _out(one: Column) -> ColumnOut:
    facts = {name: getattr(one, name) for name in ("key", "label", "group", "kind", "unit", "heading", "help")}
    return ColumnOut(**facts, choices=[Choice(value=value, label=label) for value, label in one.choices])


def _place(one: Column) -> tuple[Any, ...]:
    """The place among the columns: measures in their order, then plan fields by path with numbers in their order."""
    parts = one.key.split(".")
    return (one.group == "Plan", *((1, int(part), "") if part.isdecimal() else (0, 0, part) for part in parts))
