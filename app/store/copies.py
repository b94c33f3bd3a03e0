"""Local copies of files of a store behind a network, each under its checksum, and bounded in size."""

from __future__ import annotations

import os
import threading
import time
from contextlib import suppress
from pathlib import Path

IN_USE_S = 600.0  # a copy used within this time is not removed: it may be open, or about to be opened


class Copies:
    """Copies in a folder. Beyond `limit` bytes, those that were not used for longest are removed."""

    def __init__(self, folder: Path, limit: int):
        self.folder, self.limit = folder, limit
        self._used: dict[str, float] = {}
        self._lock = threading.Lock()

    def of(self, sha256: str) -> Path:
        """The path of the copy of a file."""
        return self.folder / sha256

    def used(self, copy: Path) -> None:
        """Remember that a copy is in use now."""
        with self._lock:
            self._used[copy.name] = time.time()

    def trim(self) -> None:
        """Remove copies until the others fit the limit."""
        found = []
        for one in os.scandir(self.folder):
            with suppress(FileNotFoundError):
                about = one.stat()
                found.append((max(self._used.get(one.name, 0.0), about.st_mtime), about.st_size, one.name))
        left = sum(size for _, size, _ in found)
        for last, size, name in sorted(found):
            if left <= self.limit or time.time() - last < IN_USE_S:
                return
            (self.folder / name).unlink(missing_ok=True)
            with self._lock:
                self._used.pop(name, None)
            left -= size
