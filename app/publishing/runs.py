"""Reports and data packages of runs, gathered from row, recording, annotations and the laboratory's identity."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from app.annotations.schemas import AnnotationOut
from app.annotations.service import AnnotationService
from app.config import Settings
from app.laboratory.service import Laboratory
from app.publishing import matlab
from app.publishing.designsafe import package
from app.publishing.designsafe.metadata import Metadata, missing
from app.publishing.letterhead import letterhead
from app.reports import html, of_run
from app.reports.document import Document
from app.reports.of_run import Annotation, Surroundings
from app.reports.pdf import pdf
from app.runs.exports import recording_path
from app.runs.schemas import RunDetail
from app.runs.service import RunService
from rths_engine.foundation import files
from rths_engine.foundation.errors import Issue
from rths_engine.parts.ground_motions import MotionLibrary
from rths_engine.recordings.run_file import Recording, load


@dataclass(frozen=True, slots=True)
class Published:
    """A run with its recording and everything that its reports say: made by a request, or by the command line from a file."""

    run: Mapping[str, Any]
    recording: Recording
    path: Path
    motions: MotionLibrary
    around: Surroundings

    @property
    def document(self) -> Document:
        """The report."""
        return of_run.document(self.run, self.recording, self.motions, self.around)

    def missing(self, given: Metadata) -> list[Issue]:
        """What a data set for DesignSafe still needs."""
        return missing(given, self.recording)

    def write_matlab(self, target: Path) -> None:
        """Write the recording as a MATLAB file. Raises Conflict for one that is too large."""
        matlab.write(target, self.run, self.recording)

    def write_designsafe(self, target: Path, given: Metadata) -> None:
        """Write the data set for DesignSafe. Raises RthsError with everything that is missing, before any report is made."""
        package.check(given, self.recording)
        document = self.document
        reports = {"report.html": html.light(document).encode(), "report.pdf": pdf(document)}
        package.write(target, self.run, self.recording, self.path, given, reports)


def of_file(path: Path, laboratory: Laboratory, motions: MotionLibrary) -> Published:
    """A recording file without a row in a database. Raises RecordingError."""
    run = {"recording": {"sha256": files.checksum(path)}} if path.exists() else {}
    around = Surroundings(letterhead(laboratory), laboratory.identity.signatures)
    return Published(run, load(path), path, motions, around)


@dataclass(frozen=True, slots=True)
class RunReports:
    """Finds what the reports of a run say."""

    runs: RunService
    annotations: AnnotationService
    laboratory: Laboratory
    settings: Settings

    def of(self, run_id: str) -> Published:
        """A run. Raises NotFound, or Conflict while there is no recording."""
        run = self.runs.get(run_id)
        path = recording_path(run, self.settings)
        noted = _noted(self.annotations.listed(run_id).annotations)
        around = Surroundings(letterhead(self.laboratory), self.laboratory.identity.signatures, noted)
        kind = run.rig.kind if run.rig else ""
        said = {"rig": run.rig_name, "rig_kind": kind, "notes": run.notes, "tags": run.tags}
        return Published(RunDetail.of(run).model_dump(mode="json") | said, load(path), path, self.runs.motions, around)


def _noted(annotations: Sequence[AnnotationOut]) -> list[Annotation]:
    return [
        Annotation(one.from_s, one.to_s, one.station, one.text, one.by, (one.edited_at or one.created_at).isoformat())
        for one in annotations
    ]
