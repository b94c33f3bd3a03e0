"""Rules of batches: import many files by one mapping, and keep the table of what differs. No SQL, no HTTP."""

from __future__ import annotations

import uuid
from collections.abc import Iterator, Sequence
from contextlib import ExitStack
from datetime import UTC, datetime
from functools import partial
from typing import BinaryIO

from app.db import afterwards
from app.measured.batch_rows import BatchRows
from app.measured.schemas import BatchOut, BatchSummary
from app.measured.service import NOBODY, MeasuredService, read_mapping, storable
from app.models import ImportBatch, MeasuredRecording
from app.problems import NotFound
from app.text import cleaned
from rths_engine.foundation.errors import Issue, MeasuredError
from rths_engine.recordings.batches import Archive, Item, Limits, Row, listing, run
from rths_engine.recordings.measured import Mapping, Measured

# docs/decisions/0028
MOST_FILES = 200
UNPACKED = 2  # times the largest request: bytes of all files of the archives of a batch
SECONDS = 300.0  # for one batch; files that are not read by then are refused


class BatchService:
    """Rules of batches. `most_bytes`: the largest size of all files of an archive, unpacked."""

    def __init__(self, recordings: MeasuredService, most_bytes: int):
        self.recordings, self.rows = recordings, BatchRows(recordings.session)
        self.limits = Limits(files=MOST_FILES, bytes=most_bytes)

    def import_(self, given: Sequence[tuple[BinaryIO, str]], mapping: str, imported_by: str, trust_mapping: bool) -> BatchOut:
        """Import the files that can be imported; the table says why others are refused.

        The files are read and written before the first change of a row, so that the database is not locked meanwhile. Raises
        MeasuredError, and stores nothing, where the mapping or an archive is not valid.
        """
        work = _Work(self.recordings, read_mapping(mapping), imported_by.strip() or NOBODY)
        with ExitStack() as stack:
            stack.callback(work.clear)
            items = work.items(self._opened(given, stack))
            found = run(items, work.mapping, work.keep, trust_mapping, SECONDS)
            work.settle(found.rows)
            rows = [cleaned(work.added(index, row)) for index, row in enumerate(found.rows)]
            batch = ImportBatch(
                id=str(uuid.uuid4()),
                mapping=work.mapping.as_dict(),
                trust_mapping=trust_mapping,
                reference=found.reference,
                imported=found.imported,
                refused=len(rows) - found.imported,
                rows=rows,
                imported_by=work.imported_by,
                imported_at=datetime.now(UTC),
            )
            self.rows.add(batch)
        return self._shown(batch)

    def listed(self, limit: int, offset: int) -> tuple[list[ImportBatch], int]:
        return self.rows.listed(limit, offset)

    def get(self, batch_id: str) -> BatchOut:
        """The batch with its rows. Raises NotFound."""
        return self._shown(self._batch(batch_id))

    def csv(self, batch_id: str) -> str:
        """The table of a batch as CSV."""
        return listing.to_csv(self.get(batch_id).model_dump()["rows"])

    def _batch(self, batch_id: str) -> ImportBatch:
        batch = self.rows.get(batch_id)
        if batch is None:
            raise NotFound(f"There is no batch {batch_id}.")
        return batch

    def _shown(self, batch: ImportBatch) -> BatchOut:
        """The batch; the recording of a row is null where it was deleted since."""
        there = self.rows.existing(row["recording"] for row in batch.rows if row["recording"])
        rows = [{**row, "recording": row["recording"] if row["recording"] in there else None} for row in batch.rows]
        summary = BatchSummary.model_validate(batch).model_dump()
        return BatchOut.model_validate({**summary, "mapping": batch.mapping, "rows": rows})

    def _opened(self, given: Sequence[tuple[BinaryIO, str]], stack: ExitStack) -> list[tuple[str, BinaryIO | Archive]]:
        """Each file by its name, those of archives by the archive that holds them. Raises MeasuredError for bad archives."""
        files: list[tuple[str, BinaryIO | Archive]] = []
        for stream, filename in given:
            name = storable(filename)
            if not name.lower().endswith(".zip"):
                files.append((name, stream))
                continue
            archive = Archive(stream, name, self.limits)
            stack.callback(archive.close)
            files += [(inner, archive) for inner in archive.names]
        if len(files) > self.limits.files:
            problem = f"are more than {self.limits.files} files"
            raise MeasuredError(Issue("files", problem, str(len(files)), "import fewer files at a time"))
        return files


class _Work:
    """The files that one batch stores: raw files, recordings and their rows, until the rows are added."""

    def __init__(self, recordings: MeasuredService, mapping: Mapping, imported_by: str):
        self.recordings, self.mapping, self.imported_by = recordings, mapping, imported_by
        self.raw: set[str] = set()
        self.written: dict[int, MeasuredRecording] = {}

    def items(self, files: Sequence[tuple[str, BinaryIO | Archive]]) -> Iterator[Item]:
        """Each file, stored under its checksum when it is its turn."""
        for name, source in files:
            try:
                if isinstance(source, Archive):
                    with source.open(name) as stream:
                        sha256, size = self.recordings.raw_files.keep(stream)
                else:
                    sha256, size = self.recordings.raw_files.keep(source)
            except MeasuredError as error:
                yield Item(name, refused=error.issues)
                continue
            self.raw.add(sha256)
            yield Item(name, size, sha256, partial(self.recordings.raw_files.table, sha256, storable(name)))

    def keep(self, index: int, item: Item, measured: Measured) -> None:
        """Write the recording of a file; its row is added later."""
        self.written[index] = self.recordings.written(measured, self.mapping, self.imported_by)
        self.written[index].filename = storable(item.name)

    def settle(self, found: Sequence[Row]) -> None:
        """Delete the raw files that cannot be read; those that can be read are deleted if the transaction fails."""
        readable = {row.sha256 for row in found if row.facts is not None}
        for sha256 in self.raw & readable:
            if self.recordings.rows.raw(sha256) is None:
                afterwards(self.recordings.session, "after_rollback", partial(self.recordings.raw_files.remove, sha256))
        self.raw -= readable
        self._forget()

    def added(self, index: int, row: Row) -> dict[str, object]:
        """The row of the table of a file; the rows of its raw file and of its recording are added.

        A refused file that can be read stays stored for a day, so that it can be imported alone.
        """
        rows = self.recordings.rows
        recording = self.written.get(index) if row.imported else None
        if row.facts is not None:
            rows.keep_raw(row.sha256, row.size, storable(row.name))
        if recording is not None:
            afterwards(self.recordings.session, "after_rollback", partial(self.recordings.discard, recording.id))
            rows.add(recording)
            del self.written[index]
        return {**listing.as_dict(row), "recording": recording.id if recording is not None else None}

    def clear(self) -> None:
        """Delete the recordings that were not added, and the raw files that were not settled and that no row needs."""
        for recording in self.written.values():
            self.recordings.discard(recording.id)
        self._forget()

    def _forget(self) -> None:
        for sha256 in self.raw:
            if self.recordings.rows.raw(sha256) is None:
                self.recordings.raw_files.remove(sha256)
        self.raw.clear()
