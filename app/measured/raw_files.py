"""Uploaded files of measurements, each stored once under its checksum, and the tables read from them."""

from __future__ import annotations

import hashlib
import threading
from functools import lru_cache
from pathlib import Path
from typing import Protocol

from app.problems import NotFound
from rths_engine.foundation import files
from rths_engine.recordings.measured import Table, read

PART = 1 << 20  # bytes
_READING = threading.Lock()  # reading takes several times the size of a file in memory, so one file is read at a time


class Stream(Protocol):
    """What is read from its start to its end."""

    def read(self, size: int, /) -> bytes: ...


class RawFiles:
    """Uploaded files in a folder, each under its SHA-256."""

    def __init__(self, folder: Path):
        self.folder = folder

    def keep(self, stream: Stream) -> tuple[str, int]:
        """Store the stream as a file, complete or not at all; returns its checksum and size (bytes)."""
        digest, size = hashlib.sha256(), 0
        self.folder.mkdir(parents=True, exist_ok=True)
        with files.temporary(self.folder / "upload") as path:
            with path.open("wb") as file:
                while part := stream.read(PART):
                    digest.update(part)
                    size += file.write(part)
            files.sync(path)
            path.replace(self.path(digest.hexdigest()))
        files.sync(self.folder)
        return digest.hexdigest(), size

    def path(self, sha256: str) -> Path:
        return self.folder / sha256

    def table(self, sha256: str, filename: str) -> Table:
        """The table in a file. Raises NotFound where the file no longer exists, MeasuredError where it can't be read."""
        with _READING:
            return _table(self.path(sha256), filename)


@lru_cache(maxsize=2)
def _table(path: Path, filename: str) -> Table:
    """The table in a file; cached, because a user reads the same file many times while editing its mapping."""
    if not path.exists():
        raise NotFound(f"The file {filename} is no longer stored. Upload it again.")
    return read(path, filename)
