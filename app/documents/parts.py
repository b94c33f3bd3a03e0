"""Tables of the parts of a plan: their kinds, and the fields of each."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from app.documents.fields import HEADS, equation, name, rows
from app.documents.markdown import code, table
from rths_engine.parts.connections import KINDS
from rths_engine.planning.safety import Limits


def kinds(registry: Sequence[type[Any]]) -> str:
    """The kinds of a registry with their equations, then every field of every kind."""
    listed = table(["kind", "name", "equation"], [(code(name(kind)), kind.title, equation(kind)) for kind in registry])
    fields = [row for kind in registry for row in rows(kind, f"{name(kind)}.")]
    return f"{listed}\n\n{table(HEADS, fields)}"


def connections() -> str:
    """The kinds of connection of a station with what they are, then every field of every kind."""
    listed = table(
        ["kind", "name", "what it is"],
        [(code(name(kind)), kind.title, (kind.__doc__ or "").partition("\n\n")[0]) for kind in KINDS],
    )
    return f"{listed}\n\n{table(HEADS, [row for kind in KINDS for row in rows(kind, f'{name(kind)}.')])}"


def limits() -> str:
    """The safety limits of a station."""
    return table(HEADS, rows(Limits))
