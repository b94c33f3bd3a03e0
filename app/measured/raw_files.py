"""Files of measurements as they came in, each once under its checksum, and the tables read from them."""

from __future__ import annotations

import hashlib
import threading
from functools import lru_cache
from pathlib import Path
from typing import BinaryIO

from app.problems import NotFound
from rths_engine.foundation import files
from rths_engine.recordings.measured import Table, read

PART = 1 << 20  # bytes
_READING = threading.Lock()  # a large file takes some times its size in memory: one is read at a time


class RawFiles:
    """Uploaded files in a folder, each under its SHA-256."""

    def __init__(self, folder: Path):
        self.folder = folder

    def keep(self, stream: BinaryIO) -> tuple[str, int]:
        """Copy the stream part by part; checksum and size. The file appears whole."""
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
        """Raises NotFound where the file is gone, MeasuredError where it can't be read."""
        with _READING:
            return _table(self.path(sha256), filename)


@lru_cache(maxsize=2)
def _table(path: Path, filename: str) -> Table:
    """The last tables read: while a mapping is worked out, the same file is looked at again and again."""
    try:
        raw = path.read_bytes()
    except FileNotFoundError:
        raise NotFound(f"The file {filename} is not kept any more; upload it again.") from None
    return read(raw, filename)
