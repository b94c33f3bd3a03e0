"""What the tests of binary formats share: read bytes by the registry's rules, and damage them."""

from __future__ import annotations

from collections.abc import Callable

from rths_engine.formats import registry
from rths_engine.formats.source import Source
from rths_engine.formats.table import Table, checked
from rths_engine.foundation.errors import FileError


def read(raw: bytes, name: str, key: str) -> Table:
    """The table in `raw`, read in this process; its content must be recognised as the format `key`."""
    source = Source(name, content=raw)
    found = registry.detected(source)
    assert found.key == key
    return checked(found.read(source))


def damaged(raw: bytes, changes: list[tuple[int, int]], cut: int) -> bytes:
    """`raw` with some bytes changed, cut at `cut` where it is odd."""
    found = bytearray(raw[: 1 + cut % len(raw)] if cut % 2 else raw)
    for at, value in changes:
        found[at % len(found)] = value
    return bytes(found)


def read_or_refused(reader: Callable[[Source], Table], raw: bytes, name: str) -> Table | None:
    """The table, or None where the file is refused. Any other error fails the test."""
    try:
        return checked(reader(Source(name, content=raw)))
    except FileError as refusal:
        assert refusal.issues
        return None
