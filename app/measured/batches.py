"""Rules of batches: import many files by one mapping, and keep the table of what differs. No SQL, no HTTP."""

from __future__ import annotations

import uuid
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, nullcontext
from datetime import UTC, datetime
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import BinaryIO

from app.db import afterwards
from app.measured import calculation
from app.measured.batch_rows import BatchRows
from app.measured.calculation import BATCH, Given, Made
from app.measured.raw_files import Upload
from app.measured.schemas import BatchOut, BatchSummary
from app.measured.service import MAPPING, NOBODY, MeasuredService, read_mapping, storable
from app.models import ImportBatch, MeasuredRecording
from app.problems import NotFound
from app.store.filed import MEASURED
from app.text import cleaned
from rths_engine.foundation.errors import Issue, MeasuredError
from rths_engine.recordings.batches import Archive, Limits, Row, listing
from rths_engine.recordings.measured import Mapping

# docs/decisions/0028
MOST_FILES = 200
UNPACKED = 2  # times the largest request: bytes of all files of the archives of a batch


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
        by = imported_by.strip() or NOBODY
        read = self.recordings.calculate(MAPPING, read_mapping, mapping)
        with ExitStack() as stack:
            uploads = [*self._received(self._opened(given, stack), stack)]
            scratch = TemporaryDirectory(prefix=".batch-", dir=self.recordings.store.scratch(MEASURED))
            folder = Path(stack.enter_context(scratch))
            files = [_given(*one) for one in uploads]
            found, made = self.recordings.calculate(BATCH, calculation.batch, files, read, trust_mapping, folder)
            ready = {index: self._written(made[index], read, by) for index, row in enumerate(found.rows) if row.imported}
            for index, row in enumerate(found.rows):
                upload = uploads[index][1]
                if row.facts is not None and isinstance(upload, Upload):
                    self.recordings.keep(upload, storable(row.name))
            rows = [cleaned(self._added(row, ready.get(index))) for index, row in enumerate(found.rows)]
            batch = ImportBatch(
                id=str(uuid.uuid4()),
                mapping=read.as_dict(),
                trust_mapping=trust_mapping,
                reference=found.reference,
                imported=found.imported,
                refused=len(rows) - found.imported,
                rows=rows,
                imported_by=by,
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

    def _received(
        self, files: Sequence[tuple[str, BinaryIO | Archive]], stack: ExitStack
    ) -> Iterator[tuple[str, Upload | tuple[Issue, ...]]]:
        """Each file in a file of its own, or why it cannot be unpacked."""
        for name, source in files:
            try:
                with source.open(name) if isinstance(source, Archive) else nullcontext(source) as stream:
                    upload = stack.enter_context(self.recordings.raw_files.received(stream))
            except MeasuredError as error:
                yield name, tuple(error.issues)
                continue
            yield name, upload

    def _written(self, made: Made, mapping: Mapping, by: str) -> MeasuredRecording:
        """The row of the recording of a file, which is not added yet; its file is removed where the transaction fails."""
        recording = self.recordings.written(made, mapping, by)
        recording.filename = storable(recording.filename)
        afterwards(self.recordings.session, "after_rollback", partial(self.recordings.discard, recording.id))
        return recording

    def _added(self, row: Row, recording: MeasuredRecording | None) -> dict[str, object]:
        """The row of the table of a file. A refused file that can be read stays stored, so that it can be imported alone."""
        if recording is not None:
            self.recordings.rows.add(recording)
        return {**listing.as_dict(row), "recording": recording.id if recording is not None else None}


def _given(name: str, upload: Upload | tuple[Issue, ...]) -> Given:
    """A file for the calculation."""
    if isinstance(upload, Upload):
        return Given(name, storable(name), upload.path, upload.size, upload.sha256)
    return Given(name, storable(name), refused=upload)
