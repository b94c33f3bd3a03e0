"""Comparison of a file with the checksum of its row, cheap for a file that was compared before and has not changed since."""

from __future__ import annotations

import os
import threading
from collections import OrderedDict
from pathlib import Path

from app.store.filed import Filed
from rths_engine.foundation import files
from rths_engine.foundation.errors import Issue, RecordingError

MOST_KNOWN = 20_000  # files whose checksum is remembered: about 5 MB
Stamp = tuple[int, int, int, int]


class Damaged(RecordingError):
    """A stored file is missing, truncated or altered."""


class Checksums:
    """Checksums of files. A file is read again only where its size, its times or its inode have changed."""

    def __init__(self) -> None:
        self._known: OrderedDict[str, tuple[Stamp, str]] = OrderedDict()
        self._lock = threading.Lock()

    def of(self, path: Path) -> tuple[str, int]:
        """Hex SHA-256 and size (bytes) of a file. Raises OSError."""
        stamp = _stamp(path)
        with self._lock:
            known = self._known.get(str(path))
            if known is not None and known[0] == stamp:
                self._known.move_to_end(str(path))
                return known[1], stamp[0]
        checksum = files.checksum(path)
        if _stamp(path) == stamp:  # nobody wrote to it meanwhile
            with self._lock:
                self._known[str(path)] = stamp, checksum
                while len(self._known) > MOST_KNOWN:
                    self._known.popitem(last=False)
        return checksum, stamp[0]


KNOWN = Checksums()


def check(path: Path, filed: Filed) -> Path:
    """The path of a file that matches its row. Raises Damaged with what differs."""
    try:
        size = path.stat().st_size
        checksum = "" if filed.size not in (None, size) else KNOWN.of(path)[0]
    except FileNotFoundError:
        raise missing(filed) from None
    except OSError as error:
        raise damaged(filed, f"cannot be read: {filed.key}: {error.strerror}") from None
    if not checksum:
        raise damaged(filed, f"is damaged: {filed.key} has {size} bytes; its row states {filed.size}")
    if checksum != filed.sha256:
        raise damaged(filed, f"is damaged: the SHA-256 of {filed.key} is {checksum}; its row states {filed.sha256}")
    return path


def missing(filed: Filed) -> Damaged:
    """The error for a file that does not exist."""
    return damaged(filed, f"is missing: the store has no file {filed.key}")


def damaged(filed: Filed, problem: str) -> Damaged:
    """The error for a file that is not as its row states."""
    return Damaged(Issue("", f"{filed.what} {problem}", fix=filed.fix))


def _stamp(path: Path) -> Stamp:
    """Size, times of the last change and inode. The second time also changes where someone sets the first."""
    found = os.stat(path)
    return found.st_size, found.st_mtime_ns, found.st_ctime_ns, found.st_ino
