"""A backup: rows at one moment, the files that they state, and the records and settings that people have put beside them."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta
from pathlib import Path

from app.backup import manifest, snapshot
from app.backup.manifest import DATABASE, Kept, Manifest
from app.config import Settings
from app.db import schemas
from app.moving.files import stated
from app.moving.places import Place
from app.store.base import Store
from app.store.filed import FMUS, LABORATORY, LEAGUE, MOTIONS, Filed
from app.store.opening import store_of
from rths_engine import __version__
from rths_engine.foundation import files
from rths_engine.foundation.errors import RecordingError, RthsError

LOOSE = (MOTIONS, FMUS, LABORATORY, LEAGUE)  # files without rows
NAMED = "rths-%Y%m%dT%H%M%SZ"
UNFINISHED = ".unfinished"


@dataclass(frozen=True, slots=True)
class Made:
    """A backup that was made: its folder and manifest, and how many files were linked to the backup before."""

    folder: Path
    manifest: Manifest
    linked: int


def make(settings: Settings, into: Path, told: Callable[[str], None]) -> Made:
    """Make a backup in a new folder of `into`. Files that the newest backup there has already are linked, not copied.

    The service may run. Files that are missing or damaged are named in the manifest and left out.
    """
    into.mkdir(parents=True, exist_ok=True)
    before = newest(into)
    moment = datetime.now(UTC)
    folder = into / f"{_free(into, moment)}{UNFINISHED}"
    folder.mkdir(mode=0o700)
    try:
        told("copying rows")
        snapshot.take(settings.url, folder / DATABASE)
        making = _Making(folder, store_of(settings), before)
        with snapshot.opened(folder / DATABASE) as rows:
            told("copying files")
            for filed in stated(Place("", rows, making.store)):
                making.keep(filed)
            making.keep_loose()
            kept = {DATABASE: Kept(files.checksum(folder / DATABASE), (folder / DATABASE).stat().st_size), **making.kept}
            schema, _ = schemas(f"sqlite:///{folder / DATABASE}")
            made = Manifest(
                moment.isoformat(), __version__, schema, snapshot.counts(rows), snapshot.audit_head(rows), kept, making.damaged
            )
        for leftover in ("-wal", "-shm"):
            (folder / f"{DATABASE}{leftover}").unlink(missing_ok=True)
        made.write(folder)
        final = folder.with_name(folder.name.removesuffix(UNFINISHED))
        folder.rename(final)
        files.sync(into)
    except BaseException:
        shutil.rmtree(folder, ignore_errors=True)
        raise
    return Made(final, made, making.linked)


def _free(into: Path, moment: datetime) -> str:
    """The name of a backup that begins now; of the next second that is free where backups follow each other within a second."""
    while (into / (name := moment.strftime(NAMED))).exists():
        moment += timedelta(seconds=1)
    return name


def newest(into: Path) -> tuple[Path, Manifest] | None:
    """The newest complete backup in a folder."""
    for folder in sorted(into.glob("rths-*Z"), reverse=True):
        with suppress(RthsError):
            return folder, manifest.read(folder)
    return None


class _Making:
    """The files of a backup while it is made."""

    def __init__(self, folder: Path, store: Store, before: tuple[Path, Manifest] | None):
        self.folder, self.store, self.before = folder, store, before
        self.kept: dict[str, Kept] = {}
        self.damaged: dict[str, str] = {}
        self.linked = 0

    def keep(self, filed: Filed) -> None:
        """Link or copy a file that a row states, if it is as the row states."""
        target = self._place(filed.key)
        known = self.before[1].files.get(filed.key) if self.before else None
        if known is not None and known.sha256 == filed.sha256 and self._linked(filed.key, target):
            self.kept[filed.key] = known
            return
        try:
            shutil.copyfile(self.store.verified(filed), target)
        except RecordingError as error:
            self.damaged[filed.key] = str(error)
            return
        self._sealed(filed.key, target)

    def keep_loose(self) -> None:
        """Copy the files that no row states."""
        for prefix in LOOSE:
            for key in self.store.listed(prefix):
                with suppress(FileNotFoundError):  # removed since it was listed
                    self.store.fetch(key, self._place(key))
                    self._sealed(key, self.folder / key)

    def _place(self, key: str) -> Path:
        target = self.folder / key
        target.parent.mkdir(parents=True, exist_ok=True)
        return target

    def _sealed(self, key: str, target: Path) -> None:
        files.sync(target)
        self.kept[key] = Kept(files.checksum(target), target.stat().st_size)

    def _linked(self, key: str, target: Path) -> bool:
        """Link a file of the backup before; false where it is gone, changed, or on a file system without links."""
        assert self.before is not None
        source = self.before[0] / key
        try:
            if source.stat().st_size != self.before[1].files[key].size:
                return False
            os.link(source, target)
        except OSError:
            return False
        self.linked += 1
        return True
