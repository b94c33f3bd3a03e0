"""What stands in an uploaded file: its header, what the header states beside what was read, and its first rows."""

from __future__ import annotations

import math
from dataclasses import asdict
from typing import Any

from pydantic import BaseModel, Field

from rths_engine.formats.statement import Statement
from rths_engine.formats.table import Table

ROWS = 8  # first rows of numbers
LONGEST_HEADER = 20_000  # characters of the header


class Stated(BaseModel):
    """A number that the header of a file states, beside the number that was read from its data."""

    what: str
    where: str
    stated: float
    read: float
    unit: str
    within: float = Field(description="the difference that rounding explains")
    agrees: bool


def of(table: Table) -> dict[str, Any]:
    """Header, statements, first rows and facts of a table, as JSON takes them."""
    return {
        "format": table.format,
        "about": table.about,
        "header": table.header[:LONGEST_HEADER],
        "header_characters": len(table.header),
        "statements": [statement(one) for one in table.statements],
        "first_rows": first_rows(table),
    }


def statement(one: Statement) -> dict[str, Any]:
    """A number of the header beside the number that was read."""
    return {**asdict(one), "agrees": one.agrees}


def first_rows(table: Table) -> list[list[float | None]]:
    """The first values of all columns, row by row; null where a column has no number there."""
    heads = [[float(value) for value in column.values[:ROWS]] for column in table.columns]
    longest = max((len(head) for head in heads), default=0)
    return [[_value(head, row) for head in heads] for row in range(longest)]


def _value(head: list[float], row: int) -> float | None:
    return head[row] if row < len(head) and math.isfinite(head[row]) else None
