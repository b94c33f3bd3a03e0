"""Reports of diagnoses, comparisons and sweeps."""

from __future__ import annotations

import json
import struct
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from app.compare.service import CompareService
from app.compare.signals import Shown
from app.diagnoses.exports import facts
from app.diagnoses.service import DiagnosisService
from app.laboratory.service import Laboratory
from app.publishing.letterhead import letterhead
from app.reports import diagnosis, of_comparison, of_sweep
from app.reports.document import Document
from app.reports.of_comparison import Curve
from app.sweeps import exports
from app.sweeps.service import SweepService
from rths_engine.foundation.errors import Issue, RthsError
from rths_engine.sweeps.table import POINT

PARTS = 1200  # of an envelope over the whole time


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


@dataclass(frozen=True, slots=True)
class ComparisonReports:
    """Makes the reports of comparisons."""

    comparisons: CompareService
    laboratory: Laboratory

    def of(self, items: Sequence[str], reference: str, station: int, floor: int) -> Document:
        """The report of a comparison, with the signals of a station and a floor. Raises as `CompareService.compare` does."""
        found = self.comparisons.compare(items, reference).model_dump(mode="json")
        curves = list(_curves(self.comparisons.signals(items, Shown(station, floor, points=PARTS))))
        signatures = self.laboratory.identity.signatures
        return of_comparison.document(found, curves, letterhead(self.laboratory), signatures, station, floor)


@dataclass(frozen=True, slots=True)
class SweepReports:
    """Makes the reports of sweeps."""

    sweeps: SweepService
    laboratory: Laboratory

    def of(self, sweep_id: str, measure: str) -> Document:
        """The report of a sweep; `measure` is the key of the result shown in full, by default the first that differs.

        Raises NotFound, and RthsError for a result that the sweep does not have.
        """
        sweep = self.sweeps.get(sweep_id)
        detail = exports.detail(sweep, self.sweeps.standing(sweep)).model_dump(mode="json")
        values: dict[str, Any] = self.sweeps.table(sweep, POINT, False, []).as_dict()
        columns = detail["columns"]
        results = [one["key"] for one in columns if one["role"] in ("measure", "outcome") and not one["categories"]]
        if measure and measure not in results:
            raise RthsError(Issue("measure", "is not a result of this sweep", measure, f"one of {', '.join(results)}"))
        chosen = measure or of_sweep.preferred(columns, values)
        return of_sweep.document(
            detail, columns, values, chosen, letterhead(self.laboratory), self.laboratory.identity.signatures
        )


def _curves(body: bytes) -> Iterator[Curve]:
    """The series of a comparison's binary body."""
    (length,) = struct.unpack_from("<I", body)
    at = 4 + length
    for one in json.loads(body[4:at])["series"]:
        values = np.frombuffer(body, "<f4", one["count"], at).astype(float)
        at += 4 * one["count"]
        time = one["start_s"] + one["step_s"] * np.arange(one["count"])
        yield Curve(one["item"], one["role"], one["form"] == "samples", time, values)
