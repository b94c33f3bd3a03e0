"""What a store does, whether its files lie in a folder or behind a network."""

from __future__ import annotations

import logging
from abc import ABC, abstractmethod
from pathlib import Path

from app.store.filed import Filed

log = logging.getLogger("rths.store")


class StoreSilent(OSError):
    """A store behind a network does not answer, or refuses; the same request may succeed later."""


class Store(ABC):
    """Files by keys such as `recordings/ID.h5`. A file is there complete or not at all.

    Every method raises OSError where the store cannot be reached or written.
    """

    where: str
    """The place of the store for people: a path or a URL without credentials."""

    @abstractmethod
    def verified(self, filed: Filed) -> Path:
        """A local file with the content that the row states, to be opened at once. Raises Damaged."""

    @abstractmethod
    def scratch(self, prefix: str) -> Path:
        """A local folder in which a file for `prefix` is written before `put`."""

    @abstractmethod
    def put(self, path: Path, key: str, sha256: str | None = None) -> None:
        """Move a complete local file to `key`. A failure leaves no part of it there; `sha256` saves reading it back."""

    @abstractmethod
    def has(self, key: str) -> bool:
        """Whether there is a file at `key`."""

    @abstractmethod
    def delete(self, key: str) -> None:
        """Delete a file; without effect where there is none."""

    def discard(self, key: str) -> None:
        """Delete a file that no row needs any more; where that fails, the file stays and the log says so."""
        try:
            self.delete(key)
        except OSError as error:
            log.warning("the file %s, which no row needs, was not deleted: %s", key, error)

    @abstractmethod
    def listed(self, prefix: str) -> dict[str, int]:
        """Key and size (bytes) of each file directly below `prefix`, without temporary files."""

    @abstractmethod
    def fetch(self, key: str, target: Path) -> None:
        """Copy a file to a local path. Raises FileNotFoundError."""

    @abstractmethod
    def folder(self, prefix: str, within_s: float = 0.0) -> Path:
        """A local folder with every file below `prefix`, as the store was at most `within_s` seconds ago."""

    @abstractmethod
    def keep(self, prefix: str, name: str) -> None:
        """Store a file that was written to `folder(prefix)`."""

    def drop(self, prefix: str, name: str) -> None:
        """Delete a file of `folder(prefix)`."""
        self.delete(f"{prefix}/{name}")
