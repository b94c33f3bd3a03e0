"""The table in a file of measurements of any known format."""

from __future__ import annotations

from pathlib import Path

from rths_engine.formats import registry
from rths_engine.formats.source import Source
from rths_engine.formats.table import Table
from rths_engine.foundation.errors import FileError, MeasuredError


def read(file: bytes | Path, name: str) -> Table:
    """The table in a file, given by its content or its path. Raises MeasuredError with what is wrong and how to mend it."""
    try:
        return registry.read(Source(name, path=file.absolute()) if isinstance(file, Path) else Source(name, content=file))
    except FileError as error:
        raise MeasuredError(error.issues) from None
