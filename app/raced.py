"""Errors of two transactions that change one row at the same moment, however the database words them."""

from __future__ import annotations

import sqlite3

from sqlalchemy.exc import IntegrityError, InvalidRequestError
from sqlalchemy.orm.exc import ObjectDeletedError, StaleDataError

KINDS = (StaleDataError, IntegrityError, InvalidRequestError)
"""The errors among which `is_raced` finds those."""
SQLITE = {
    sqlite3.SQLITE_CONSTRAINT_UNIQUE,
    sqlite3.SQLITE_CONSTRAINT_PRIMARYKEY,
    sqlite3.SQLITE_CONSTRAINT_FOREIGNKEY,
}
POSTGRES = {"23503", "23505"}  # foreign_key_violation, unique_violation
NOT_REFRESHED = "Could not refresh instance"  # SQLAlchemy has no kind of its own for a row that is gone


def is_raced(error: BaseException) -> bool:
    """Whether an error says that a row was added, changed or deleted by another transaction since it was read.

    Other broken constraints, such as an empty column, are faults of the program.
    """
    if isinstance(error, StaleDataError | ObjectDeletedError):
        return True
    if isinstance(error, IntegrityError):
        given = error.orig
        return getattr(given, "sqlite_errorcode", None) in SQLITE or getattr(given, "sqlstate", None) in POSTGRES
    return isinstance(error, InvalidRequestError) and str(error).startswith(NOT_REFRESHED)
