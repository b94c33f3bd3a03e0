"""Uploaded files of measurements, each stored once under its checksum.

Requests with the same content meet under one checksum. An upload is read from a file of its own, and comes under its checksum
only when it can be read: a refused upload touches nothing that another request reads. A stored file is removed while its place
in the table of files is held, so that nobody else can add its row meanwhile.
"""

from __future__ import annotations

import hashlib
import logging
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

from sqlalchemy.orm import Session

from app.db import DATABASE_SILENT, sessions
from app.measured.repository import MeasuredRepository
from app.problems import Unavailable
from app.store.base import Store
from app.store.filed import RAW, RESTORE, Filed, of_raw
from rths_engine.foundation import files

log = logging.getLogger("rths.store")
PART = 1 << 20  # bytes


class Stream(Protocol):
    """What is read from its start to its end."""

    def read(self, size: int, /) -> bytes: ...


@dataclass(frozen=True, slots=True)
class Upload:
    """The content of a request, in a file of its own."""

    path: Path
    sha256: str
    size: int


class RawFiles:
    """Uploaded files in the store, each under its SHA-256."""

    def __init__(self, store: Store):
        self.store = store

    @contextmanager
    def received(self, stream: Stream) -> Iterator[Upload]:
        """The content of a stream in a file of its own, which is removed at the end unless it was kept."""
        digest, size = hashlib.sha256(), 0
        with files.temporary(self.store.scratch(RAW) / "upload") as path:
            with path.open("wb") as file:
                while part := stream.read(PART):
                    digest.update(part)
                    size += file.write(part)
            files.sync(path)
            yield Upload(path, digest.hexdigest(), size)

    def keep(self, session: Session, upload: Upload, filename: str) -> None:
        """Store an upload under its checksum, and add or renew its row. Raises Unavailable while it is being removed."""
        self.store.put(upload.path, of_raw(upload.sha256), upload.sha256)
        MeasuredRepository(session).keep_raw(upload.sha256, upload.size, filename)  # waits for a removal of this content
        if not self.store.has(of_raw(upload.sha256)):
            raise Unavailable(f"The file {filename} was being removed at the same time. Upload it again.")

    def verified(self, sha256: str, filename: str) -> Path:
        """A local file with the content of an uploaded file. Raises Damaged."""
        fix = f"{RESTORE}, or upload it again"
        return self.store.verified(Filed(of_raw(sha256), f"The uploaded file {filename}", sha256, None, fix))

    def remove_unused(self, session: Session, sha256: str) -> None:
        """Delete a file that has no row, after a transaction of `session` has ended."""
        try:
            with sessions(session.get_bind().engine)() as own:  # ends without a commit: the place is held, never taken
                if MeasuredRepository(own).held(sha256):
                    self.store.discard(of_raw(sha256))
        except DATABASE_SILENT as error:
            log.warning("the file %s, which no row needs, was not deleted: %s", of_raw(sha256), error)
