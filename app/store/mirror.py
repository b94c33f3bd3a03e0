"""A local folder that follows a prefix of a store behind a network: ground motions, FMUs, the laboratory's identity."""

from __future__ import annotations

import json
import threading
import time
from pathlib import Path
from typing import Any, Protocol

from rths_engine.foundation import files

STAMPS = ".stamps.json"
TELLING = ("ETag", "etag", "LastModified", "mtime", "created")  # what file systems say about the content of an object


class Origin(Protocol):
    """The store that a mirror follows."""

    def described(self, prefix: str) -> dict[str, Any]: ...
    def fetch(self, key: str, target: Path) -> None: ...
    def upload(self, path: Path, key: str) -> None: ...


class Mirror:
    """Keeps `folder` equal to the files directly below `prefix`. A file whose size or stamp differs is fetched again."""

    def __init__(self, store: Origin, prefix: str, folder: Path):
        self.store, self.prefix, self.path = store, prefix, folder
        self._lock = threading.Lock()
        self._looked_at = float("-inf")

    def refreshed(self, within_s: float) -> Path:
        """The folder, as the store was at most `within_s` seconds ago. Raises OSError."""
        with self._lock:
            if time.monotonic() - self._looked_at > within_s:
                self._refresh()
                self._looked_at = time.monotonic()
        return self.path

    def keep(self, name: str) -> None:
        """Store a file that was written to the folder. A file that cannot be stored is removed from the folder."""
        try:
            self.store.upload(self.path / name, f"{self.prefix}/{name}")
        except OSError:
            self.forget(name)
            raise
        with self._lock:
            self._write({**self._known(), name: ""})  # known, so that it goes when another machine deletes it
            self._looked_at = float("-inf")

    def forget(self, name: str) -> None:
        """Remove a file from the folder."""
        (self.path / name).unlink(missing_ok=True)
        self._looked_at = float("-inf")

    def _refresh(self) -> None:
        self.path.mkdir(parents=True, exist_ok=True)
        there = {name: _stamp(about) for name, about in self.store.described(self.prefix).items()}
        known = self._known()
        for name, stamp in there.items():
            if known.get(name) != stamp or not (self.path / name).exists():
                with files.temporary(self.path / name) as written:
                    try:
                        self.store.fetch(f"{self.prefix}/{name}", written)
                    except FileNotFoundError:  # deleted meanwhile
                        continue
                    written.replace(self.path / name)
        for name in known.keys() - there.keys():
            (self.path / name).unlink(missing_ok=True)
        if known != there:
            self._write(there)

    def _write(self, stamps: dict[str, str]) -> None:
        files.write(self.path / STAMPS, json.dumps(stamps))

    def _known(self) -> dict[str, str]:
        try:
            found: dict[str, str] = json.loads((self.path / STAMPS).read_text(encoding="utf-8"))
            return found
        except (OSError, ValueError):
            return {}


def _stamp(about: dict[str, Any]) -> str:
    return " ".join(str(about[name]) for name in ("size", *TELLING) if name in about)
