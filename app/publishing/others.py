"""Reports of diagnoses."""

from __future__ import annotations

from dataclasses import dataclass

from app.diagnoses.exports import facts
from app.diagnoses.service import DiagnosisService
from app.laboratory.service import Laboratory
from app.publishing.letterhead import letterhead
from app.reports import diagnosis
from app.reports.document import Document


@dataclass(frozen=True, slots=True)
class DiagnosisReports:
    """Makes the reports of diagnoses."""

    diagnoses: DiagnosisService
    laboratory: Laboratory

    def of(self, diagnosis_id: str) -> Document:
        """The report of a diagnosis. Raises NotFound, or Conflict where it has no result."""
        found, verdict, pictures = self.diagnoses.result(diagnosis_id)
        rows = [*facts(found), ("Identifier", found.id)]
        signatures = self.laboratory.identity.signatures
        return diagnosis.document(found.name, rows, verdict, pictures, found.plan, letterhead(self.laboratory), signatures)
