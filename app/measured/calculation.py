"""Reading of measured files, each in a process of its own: the service gets what it stores and shows, never the samples."""

from __future__ import annotations

import uuid
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any

from app import contents
from app.calculations.bound import Bound
from app.config import MEGABYTE
from app.measured import shown
from rths_engine.foundation import files
from rths_engine.foundation.errors import Issue, MeasuredError
from rths_engine.recordings.batches import Batch, Item, run
from rths_engine.recordings.measured import Mapping, Measured, Table, check, examine, fingerprint, guess, imported, read, save

LARGE = 50 * MEGABYTE
# A large file is mapped into memory, which counts as memory here: rths_engine/formats/scratch.py
READING = Bound("reading of the file", seconds=30, megabytes=4000, mend="export fewer columns or samples", where="file")
LARGE_READING = replace(READING, seconds=200, megabytes=60_000, long=True)
BATCH_S = 300  # for one batch; files that are not read by then are refused
BATCH = replace(LARGE_READING, noun="reading of the batch", seconds=BATCH_S + 60, mend="import fewer files at a time")


@dataclass(frozen=True, slots=True)
class FileRead:
    """What is kept of a file that was read: its layout and format, its columns, and what the pages show of it."""

    layout: str
    format: str
    columns: list[dict[str, str]]
    shown: dict[str, Any]


@dataclass(frozen=True, slots=True)
class Made:
    """A recording that was made of a file: its HDF5 file, which is still to be stored, and what its row states."""

    path: Path
    row: dict[str, Any]


@dataclass(frozen=True, slots=True)
class Given:
    """A file of a batch: where its content lies, or why it is refused."""

    name: str
    filename: str
    path: Path | None = None
    size: int = 0
    sha256: str = ""
    refused: tuple[Issue, ...] = ()


def bound_of(size: int) -> Bound:
    """The bound for reading a file of a size (bytes)."""
    return LARGE_READING if size > LARGE else READING


def facts(path: Path, filename: str, mapping: Mapping | None = None) -> FileRead:
    """What is kept of a file. Raises MeasuredError where it cannot be read, or where a mapping does not fit it."""
    table = read(path, filename)
    if mapping is not None:
        check(table, mapping)
    columns = [{"name": one.name, "unit": one.unit} for one in table.columns]
    described = {**contents.of(table), "columns": [shown.column(one) for one in table.columns], **_guessed(table)}
    return FileRead(fingerprint(table), table.format, columns, described)


def previewed(path: Path, filename: str, mapping: Mapping, part: shown.Part) -> dict[str, Any]:
    """The channels of a file by a mapping. Raises MeasuredError for a mapping that does not fit."""
    return shown.examined(examine(read(path, filename), mapping), mapping, part)


def recording(path: Path, filename: str, sha256: str, mapping: Mapping, title: str, target: Path) -> Made:
    """Write the recording of a file to `target`. Raises MeasuredError with every error."""
    measured = imported(read(path, filename), mapping, filename, sha256)
    return _made(replace(measured, title=title), target)


def batch(given: Sequence[Given], mapping: Mapping, trust_mapping: bool, folder: Path) -> tuple[Batch, dict[int, Made]]:
    """Read the files of a batch and write their recordings to a folder, by the place of each file."""
    made: dict[int, Made] = {}

    def keep(index: int, _: Item, measured: Measured) -> None:
        made[index] = _made(measured, folder / f"{uuid.uuid4()}.h5")

    items = [
        Item(one.name, one.size, one.sha256, partial(read, one.path, one.filename) if one.path else None, one.refused)
        for one in given
    ]
    return run(items, mapping, keep, trust_mapping, BATCH_S), made


def _made(measured: Measured, target: Path) -> Made:
    save(target, measured)
    row = {
        "name": measured.title,
        "test": measured.test,
        "raw_sha256": measured.source_sha256,
        "filename": measured.source,
        "channels": [shown.described(channel) for channel in measured.channels],
        "warnings": [warning.as_dict() for warning in measured.warnings],
        "dt_s": measured.dt,
        "start_s": measured.start,
        "samples": measured.samples,
        "sha256": files.checksum(target),
        "size": target.stat().st_size,
    }
    return Made(target, row)


def _guessed(table: Table) -> dict[str, Any]:
    try:
        found = guess(table)
    except MeasuredError as error:
        return {"guess": None, "reasons": {}, "doubtful": [], "left_out": {}, "notes": [*table.notes, f"{error}."]}
    explained = {
        "reasons": found.reasons,
        "doubtful": list(found.doubtful),
        "left_out": found.left_out,
        "notes": list(found.notes),
    }
    return {"guess": found.mapping.as_dict(), **explained}
