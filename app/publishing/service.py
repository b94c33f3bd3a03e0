"""Reports of runs and diagnoses, gathered from their rows, recordings, annotations and the laboratory's identity."""

from __future__ import annotations

from dataclasses import dataclass

from app.annotations.schemas import AnnotationOut
from app.annotations.service import AnnotationService
from app.config import Settings
from app.diagnoses.exports import facts
from app.diagnoses.service import DiagnosisService
from app.laboratory.service import Laboratory
from app.reports import diagnosis, of_run
from app.reports.document import Document, Letterhead
from app.reports.of_run import Annotation, Surroundings
from app.runs.exports import recording_path
from app.runs.schemas import RunDetail
from app.runs.service import RunService
from rths_engine.recordings.run_file import load


@dataclass(frozen=True, slots=True)
class Publishing:
    """Makes the reports of runs and diagnoses."""

    runs: RunService
    annotations: AnnotationService
    diagnoses: DiagnosisService
    laboratory: Laboratory
    settings: Settings

    def of_run(self, run_id: str) -> Document:
        """The report of a run. Raises NotFound, or Conflict while there is no recording."""
        run = self.runs.get(run_id)
        recording = load(recording_path(run, self.settings))
        noted = [_annotation(one) for one in self.annotations.listed(run_id).annotations]
        around = Surroundings(letterhead(self.laboratory), self.laboratory.identity.signatures, noted)
        said = {**RunDetail.of(run).model_dump(mode="json"), "rig": run.rig_name, "notes": run.notes, "tags": run.tags}
        return of_run.document(said, recording, self.runs.motions, around)

    def of_diagnosis(self, diagnosis_id: str) -> Document:
        """The report of a diagnosis. Raises NotFound, or Conflict where it has no result."""
        found, verdict, pictures = self.diagnoses.result(diagnosis_id)
        rows = [*facts(found), ("Identifier", found.id)]
        signatures = self.laboratory.identity.signatures
        return diagnosis.document(found.name, rows, verdict, pictures, found.plan, letterhead(self.laboratory), signatures)


def _annotation(one: AnnotationOut) -> Annotation:
    written = (one.edited_at or one.created_at).isoformat()
    return Annotation(one.from_s, one.to_s, one.station, one.text, one.by, written)


def letterhead(laboratory: Laboratory) -> Letterhead:
    """The head of a report."""
    identity, logo = laboratory.identity, laboratory.logo
    return Letterhead(identity.name, identity.address, (logo.data, logo.media_type) if logo else None)
