"""Files that `rths import` reads: measurements and a mapping."""

from __future__ import annotations

from pathlib import Path

from rths_engine.foundation.errors import Issue, MeasuredError
from rths_engine.recordings.measured import Mapping


def content(path: Path, where: str) -> bytes:
    """The bytes of a file. Raises MeasuredError at `where` if it cannot be read."""
    try:
        return path.read_bytes()
    except OSError as error:
        raise MeasuredError(Issue(where, f"cannot be read: {error.strerror}", str(path))) from None


def mapping(path: Path) -> Mapping:
    """The mapping in a YAML file. Raises MeasuredError with every issue."""
    try:
        return Mapping.from_yaml(content(path, "--map").decode("utf-8"))
    except UnicodeDecodeError:
        fix = "`rths import FILE --guess` prints a proposed mapping"
        raise MeasuredError(Issue("--map", "is not valid UTF-8 text", str(path), fix)) from None
