"""Conditions that every list of runs has: the shelf, archived or not, and the search for a text."""

from __future__ import annotations

from enum import StrEnum

import sqlalchemy as sa

from app.models import Run
from app.runs.conditions import contains


class Shelf(StrEnum):
    """The runs that a list shows: all but archived ones, archived ones only, both, or those that are deleted."""

    SHOWN = "shown"
    ARCHIVED = "archived"
    ALL = "all"
    DELETED = "deleted"


def on_shelf(shelf: Shelf) -> list[sa.ColumnElement[bool]]:
    """The conditions of a shelf."""
    kept: list[sa.ColumnElement[bool]] = [Run.deleted_at.is_not(None) if shelf is Shelf.DELETED else Run.deleted_at.is_(None)]
    if shelf in (Shelf.SHOWN, Shelf.ARCHIVED):
        kept.append(Run.archived.is_(shelf is Shelf.ARCHIVED))
    return kept


def searched(text: str) -> list[sa.ColumnElement[bool]]:
    """The condition of a search: in name, id and tags; `#123` is the number of a run only."""
    number = text.removeprefix("#")
    exact = number.isascii() and number.isdecimal() and len(number) < 10
    if text.startswith("#"):
        return [Run.number == int(number)] if exact else [sa.false()]
    if not text:
        return []
    found = [contains(Run.name, text), contains(Run.id, text), contains(sa.type_coerce(Run.tags, sa.Text), text)]
    return [sa.or_(*found, *([Run.number == int(number)] if exact else []))]
