"""Read a file by the registry, and the words of its refusal."""

from __future__ import annotations

import pytest

from rths_engine.formats import registry
from rths_engine.formats.source import Source
from rths_engine.formats.table import Table
from rths_engine.foundation.errors import FileError


def table(raw: bytes, name: str = "record.txt") -> Table:
    """The table of a ground motion."""
    return registry.read(Source(name, content=raw), registry.RECORD)


def refused(raw: bytes, *words: str, name: str = "record.txt") -> None:
    """The file is refused with a sentence that contains all `words`."""
    with pytest.raises(FileError) as caught:
        table(raw, name)
    for word in words:
        assert word in str(caught.value), str(caught.value)


def never_crashes(raw: bytes, step: int = 101) -> None:
    """The file cut at many places, and with many bytes lost, is read or refused."""
    for cut in range(1, len(raw), step):
        for part in (raw[:cut], raw[cut:], raw[:cut] + raw[cut + 1 :], raw[:cut] + b"x" + raw[cut + 1 :]):
            try:
                table(part)
            except FileError as error:
                assert all(issue.problem for issue in error.issues)
