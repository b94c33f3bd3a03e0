"""Rules of measured recordings: upload, preview, import and remove. No SQL, no HTTP."""

from __future__ import annotations

import re
import uuid
from collections.abc import Sequence
from dataclasses import replace
from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import Any, BinaryIO

from sqlalchemy.exc import IntegrityError
from sqlalchemy.orm import Session

from app.calculations.answer import HERE, Calculate
from app.calculations.bound import Bound
from app.db import afterwards
from app.measured import calculation, shown
from app.measured.calculation import FileRead, Made, bound_of
from app.measured.raw_files import RawFiles, Upload
from app.measured.repository import MeasuredRepository
from app.measured.saved_mappings import SavedMappings
from app.measured.schemas import EarlierMapping, Import, NewMapping, Preview, SavedMappingOut, Uploaded
from app.models import MeasuredRecording, RawFile, SavedMapping
from app.problems import Conflict, NotFound
from app.store.base import Store
from app.store.filed import MEASURED, Filed, of_measured
from app.text import refuse_unstorable
from rths_engine import __version__
from rths_engine.foundation import files
from rths_engine.recordings.measured import Mapping, mapping_yaml
from rths_engine.recordings.opening import load

KEPT_UNUSED = timedelta(days=1)  # a file from which nothing is imported
EARLIER = 200  # imports among which a mapping is looked for
NOBODY = "unnamed"
MAPPING = Bound("reading of the mapping", seconds=10, megabytes=1000, mend="use fewer columns", where="mapping")


class MeasuredService:
    """Rules of measured recordings: upload, preview, import and remove. No SQL, no HTTP."""

    def __init__(self, session: Session, store: Store, calculate: Calculate = HERE):
        self.session, self.store, self.calculate = session, store, calculate
        self.rows, self.raw_files = MeasuredRepository(session), RawFiles(store)
        self.saved = SavedMappings(session)

    def upload(self, stream: BinaryIO, filename: str) -> Uploaded:
        """Store a file that can be read. Raises MeasuredError for any other file, and stores nothing of it."""
        name = storable(filename)
        with self.raw_files.received(stream) as upload:
            found = self.calculate(bound_of(upload.size), calculation.facts, upload.path, name)
            self.keep(upload, name)
        for old in self.rows.abandoned(datetime.now(UTC) - KEPT_UNUSED):
            self._forget_raw(old)
        return self._described(upload.sha256, upload.size, name, found)

    def keep(self, upload: Upload, filename: str) -> None:
        """Store an uploaded file with its row, or nothing of it where the transaction fails."""
        afterwards(self.session, "after_rollback", lambda: self.raw_files.remove_unused(self.session, upload.sha256))
        self.raw_files.keep(self.session, upload, filename)

    def bound(self, sha256: str) -> Bound:
        """The bound for reading an uploaded file. Raises NotFound."""
        return bound_of(self._raw(sha256).size)

    def uploaded(self, sha256: str) -> Uploaded:
        raw = self._raw(sha256)
        path = self.raw_files.verified(sha256, raw.filename)
        return self._described(sha256, raw.size, raw.filename, calculation.facts(path, raw.filename))

    def preview(self, asked: Preview) -> dict[str, Any]:
        """The channels by a mapping, decimated, with all findings. Raises MeasuredError for a mapping that does not fit."""
        raw, mapping = self._raw(asked.file), read_mapping(asked.mapping)
        path = self.raw_files.verified(raw.sha256, raw.filename)
        return calculation.previewed(path, raw.filename, mapping, shown.Part(asked.from_s, asked.to_s))

    def save_mapping(self, asked: NewMapping) -> SavedMapping:
        """Save a mapping under a name for files of the layout of an uploaded file."""
        raw = self._raw(asked.file)
        mapping = self.calculate(MAPPING, read_mapping, asked.mapping)
        path = self.raw_files.verified(raw.sha256, raw.filename)
        found = self.calculate(bound_of(raw.size), calculation.facts, path, raw.filename, mapping)
        return self.saved.save(asked.name, mapping, found, asked.saved_by.strip() or NOBODY)

    def import_(self, asked: Import) -> MeasuredRecording:
        """Write the recording, then its row. Raises MeasuredError with every error."""
        raw = self._raw(asked.file)
        mapping = self.calculate(MAPPING, read_mapping, asked.mapping)
        name = asked.name.strip() or mapping.title or raw.filename
        given = self.raw_files.verified(raw.sha256, raw.filename), raw.filename, raw.sha256
        with files.temporary(self.store.scratch(MEASURED) / "recording.h5") as target:
            made = self.calculate(bound_of(raw.size), calculation.recording, *given, mapping, name, target)
            recording = self.written(made, mapping, asked.imported_by)
        afterwards(self.session, "after_rollback", lambda: self.discard(recording.id))
        if not self.rows.locked_raw(raw.sha256):
            raise NotFound(f"The file {raw.filename} is no longer stored. Upload it again.")
        self.rows.add(recording)
        return recording

    def written(self, made: Made, mapping: Mapping, imported_by: str) -> MeasuredRecording:
        """The row of a recording, which is not added yet; the file of the recording is stored."""
        recording_id = str(uuid.uuid4())
        self.store.put(made.path, of_measured(recording_id), made.row["sha256"])
        return MeasuredRecording(
            id=recording_id,
            mapping=mapping.as_dict(),
            imported_by=imported_by.strip() or NOBODY,
            imported_at=datetime.now(UTC),
            code_version=__version__,
            **made.row,
        )

    def get(self, recording_id: str) -> MeasuredRecording:
        recording = self.rows.get(recording_id)
        if recording is None:
            raise NotFound(f"There is no recording {recording_id}.")
        return recording

    def listed(self, limit: int, offset: int) -> tuple[list[MeasuredRecording], int]:
        return self.rows.listed(limit, offset)

    def channels(self, recording_id: str, part: shown.Part) -> dict[str, Any]:
        """The channels of a recording in a part of its time, decimated, in the order of its mapping."""
        order = [one["key"] for one in self.get(recording_id).channels]
        measured = load(self.hdf5(recording_id))
        channels = sorted(measured.channels, key=lambda one: order.index(one.key))
        return shown.preview(replace(measured, channels=tuple(channels)), part=part)

    def hdf5(self, recording_id: str) -> Path:
        """The verified file of a recording. Raises Damaged."""
        return self.store.verified(filed(self.get(recording_id)))

    def raw(self, recording_id: str) -> tuple[Path, str]:
        """The path and the name of the file that a recording was imported from."""
        recording = self.get(recording_id)
        return self.raw_files.verified(recording.raw_sha256, recording.filename), recording.filename

    def mapping_text(self, recording_id: str) -> str:
        return mapping_yaml.write(Mapping.read(self.get(recording_id).mapping))

    def remove(self, recording_id: str) -> None:
        """Remove a recording. Raises Conflict while something refers to it."""
        recording = self.get(recording_id)
        name, raw_sha256 = recording.name, recording.raw_sha256
        self.rows.locked_raw(raw_sha256)
        recording = self.get(recording_id)  # another request may have removed it before the lock
        uses = self.rows.uses(recording)
        if uses:
            users = ", ".join(f"{count} × {name.replace('_', ' ')}" for name, count in uses.items())
            raise Conflict(f"The recording {recording.name} is in use ({users}). Remove these first.")
        try:
            self.rows.remove(recording)
        except IntegrityError:
            raise Conflict(f"The recording {name} is in use: another request has just started to use it.") from None
        afterwards(self.session, "after_commit", lambda: self.discard(recording.id))
        self._forget_raw(raw_sha256)

    def mappings(self) -> list[EarlierMapping]:
        """The mappings of earlier imports, newest first, each once."""
        found: list[EarlierMapping] = []
        for one in self.rows.listed(EARLIER, 0)[0]:
            if all(one.mapping != other.mapping for other in found):
                found.append(EarlierMapping(recording=one.id, name=one.name, imported_at=one.imported_at, mapping=one.mapping))
        return found

    def discard(self, recording_id: str) -> None:
        """Delete the file of a recording that has no row."""
        self.store.discard(of_measured(recording_id))

    def _raw(self, sha256: str) -> RawFile:
        raw = self.rows.raw(sha256)
        if raw is None:
            raise NotFound(f"There is no uploaded file {sha256}. Upload it again; unused files are deleted after one day.")
        return raw

    def _forget_raw(self, sha256: str) -> None:
        if self.rows.forget_raw(sha256):
            afterwards(self.session, "after_commit", lambda: self.raw_files.remove_unused(self.session, sha256))

    def _described(self, sha256: str, size: int, filename: str, found: FileRead) -> Uploaded:
        return Uploaded(
            sha256=sha256,
            size=size,
            filename=filename,
            layout=found.layout,
            saved=[SavedMappingOut.model_validate(one) for one in self.saved.fitting(found.layout)],
            mappings=[one for one in self.mappings() if _fits(one.mapping, [column["name"] for column in found.columns])],
            **found.shown,
        )


def read_mapping(given: dict[str, Any] | str) -> Mapping:
    """The mapping in JSON, or in YAML as text. Raises MeasuredError with every issue."""
    mapping = Mapping.from_yaml(given) if isinstance(given, str) else Mapping.read(given)
    refuse_unstorable({"mapping": mapping.as_dict()})
    return mapping


def _fits(mapping: dict[str, Any], names: Sequence[str]) -> bool:
    wanted = [one[name] for one in mapping["channels"] for name in ("column", "time") if one.get(name) is not None]
    return all(one in names or (isinstance(one, int) and one <= len(names)) for one in wanted)


def filed(recording: MeasuredRecording) -> Filed:
    """The file of a recording as its row describes it."""
    what = f"The recording {recording.number} ({recording.name})"
    return Filed(of_measured(recording.id), what, recording.sha256, recording.size)


def storable(filename: str) -> str:
    """A file name without its folder and without characters that a database or an HTTP header cannot hold."""
    name = re.split(r"[/\\]", filename)[-1]
    return re.sub("[\x00-\x1f\x7f\ud800-\udfff]", "", name).strip()[-255:] or "measurements"
