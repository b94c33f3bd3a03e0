"""Uploaded files of measurements, each stored once under its checksum, and the tables read from them."""

from __future__ import annotations

import hashlib
import threading
from functools import lru_cache
from pathlib import Path
from typing import Protocol

from app.store.base import Store
from app.store.filed import RAW, RESTORE, Filed, of_raw
from rths_engine.foundation import files
from rths_engine.recordings.measured import Table, read

PART = 1 << 20  # bytes
_READING = threading.Lock()  # reading takes several times the size of a file in memory, so one file is read at a time


class Stream(Protocol):
    """What is read from its start to its end."""

    def read(self, size: int, /) -> bytes: ...


class RawFiles:
    """Uploaded files in the store, each under its SHA-256."""

    def __init__(self, store: Store):
        self.store = store

    def keep(self, stream: Stream) -> tuple[str, int]:
        """Store the stream as a file, complete or not at all; returns its checksum and size (bytes)."""
        digest, size = hashlib.sha256(), 0
        with files.temporary(self.store.scratch(RAW) / "upload") as path:
            with path.open("wb") as file:
                while part := stream.read(PART):
                    digest.update(part)
                    size += file.write(part)
            files.sync(path)
            sha256 = digest.hexdigest()
            self.store.put(path, of_raw(sha256), sha256)
        return sha256, size

    def verified(self, sha256: str, filename: str) -> Path:
        """A local file with the content of an uploaded file. Raises Damaged."""
        fix = f"{RESTORE}, or upload it again"
        return self.store.verified(Filed(of_raw(sha256), f"The uploaded file {filename}", sha256, None, fix))

    def remove(self, sha256: str) -> None:
        """Delete a file that has no row."""
        self.store.discard(of_raw(sha256))

    def table(self, sha256: str, filename: str) -> Table:
        """The table in a file. Raises Damaged where the file is missing or altered, MeasuredError where it can't be read."""
        with _READING:
            return _table(self.verified(sha256, filename), filename)


@lru_cache(maxsize=2)
def _table(path: Path, filename: str) -> Table:
    """The table in a file; cached, because a user reads the same file many times while editing its mapping."""
    return read(path, filename)
