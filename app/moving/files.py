"""Files, copied from one store to another and compared with their checksums."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from pathlib import Path

import sqlalchemy as sa

from app.models import MeasuredRecording, RawFile, Run
from app.moving.places import Place
from app.store.base import Store
from app.store.checks import Damaged
from app.store.filed import FMUS, LABORATORY, LEAGUE, MEASURED, MOTIONS, RAW, RECORDINGS, Filed, of_measured, of_raw, of_run
from rths_engine.foundation import files

PREFIXES = (RECORDINGS, MEASURED, RAW, MOTIONS, FMUS, LABORATORY, LEAGUE)


def stated(place: Place) -> Iterator[Filed]:
    """Every file that a row states, with its checksum."""
    with place.rows.connect() as connection:
        recorded = sa.select(Run.id, Run.number, Run.recording_sha256, Run.recording_size)
        for run_id, number, sha256, size in connection.execute(recorded.where(Run.recording_sha256.is_not(None))):
            yield Filed(of_run(run_id), f"The recording of run {number}", sha256 or "", size)
        imported = sa.select(MeasuredRecording.id, MeasuredRecording.number, MeasuredRecording.sha256, MeasuredRecording.size)
        for recording_id, number, sha256, size in connection.execute(imported):
            yield Filed(of_measured(recording_id), f"The recording {number}", sha256, size)
        for sha256, size, filename in connection.execute(sa.select(RawFile.sha256, RawFile.size, RawFile.filename)):
            yield Filed(of_raw(sha256), f"The uploaded file {filename}", sha256, size)


def damaged(place: Place) -> dict[str, str]:
    """Key and problem of each file that is not as its row states."""
    found = {}
    for filed in stated(place):
        try:
            place.store.verified(filed)
        except Damaged as error:
            found[filed.key] = str(error)
    return found


def listed(store: Store) -> dict[str, int]:
    """Key and size of every file of a store."""
    return {key: size for prefix in PREFIXES for key, size in store.listed(prefix).items()}


def copy(source: Store, target: Store) -> int:
    """Copy the files that the target lacks or has in another size; returns their number."""
    there, copied = listed(target), 0
    for key, size in listed(source).items():
        if there.get(key) != size:
            path = target.scratch(key.rpartition("/")[0]) / f".move-{key.rpartition('/')[2]}"
            try:
                source.fetch(key, path)
                files.sync(path)
                target.put(path, key)
            finally:
                path.unlink(missing_ok=True)
            copied += 1
    return copied


def different(source: Store, target: Store) -> list[str]:
    """Keys of the files that are in one store only, or whose checksums differ. Every file is read from both stores."""
    here, there = listed(source), listed(target)
    found = sorted(here.keys() ^ there.keys())
    with tempfile.TemporaryDirectory(prefix="rths-move-") as folder:
        for key in sorted(here.keys() & there.keys()):
            if _checksum(source, key, Path(folder)) != _checksum(target, key, Path(folder)):
                found.append(key)
    return found


def _checksum(store: Store, key: str, folder: Path) -> str:
    path = folder / "file"
    store.fetch(key, path)
    return files.checksum(path)
