"""Errors of a library or of a reader become the refusal of a file: a damaged file can cause an error of any kind."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from rths_engine.foundation.errors import FileError, Issue

FIX = "write the file again, or export it as CSV"


@contextmanager
def refused(title: str, fix: str = FIX) -> Iterator[None]:
    """Raises FileError, with the kind and the text of the error, for every error in the block."""
    try:
        yield
    except FileError:
        raise
    except Exception as error:
        told = " ".join(str(error).split())[:200]
        problem = f"cannot be read as {title}: {type(error).__name__}{told and f': {told}'}"
        raise FileError(Issue("file", problem, fix=fix)) from None
