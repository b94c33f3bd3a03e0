"""Database queries of diagnoses. They never commit."""

from __future__ import annotations

import sqlalchemy as sa
from sqlalchemy.orm import Session

from app.jobs.repository import JobRepository
from app.models import Diagnosis


class DiagnosisRepository(JobRepository[Diagnosis]):
    """Database queries of diagnoses. They never commit."""

    def __init__(self, session: Session):
        super().__init__(session, Diagnosis)

    def listed(self, limit: int, offset: int) -> tuple[list[Diagnosis], int]:
        total = self.session.scalar(sa.select(sa.func.count()).select_from(Diagnosis)) or 0
        query = sa.select(Diagnosis).order_by(Diagnosis.number.desc()).limit(limit).offset(offset)
        return list(self.session.scalars(query)), total

    def extended(self, limit: int) -> list[Diagnosis]:
        """The newest diagnoses whose verdict has an extended plan."""
        plan = Diagnosis.verdict["extended_plan"].as_string()
        query = sa.select(Diagnosis).where(Diagnosis.found == "mismatch", plan.is_not(None))
        return list(self.session.scalars(query.order_by(Diagnosis.number.desc()).limit(limit)))
