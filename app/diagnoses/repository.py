"""SQL of diagnoses. Never commits."""

from __future__ import annotations

from typing import Any

import sqlalchemy as sa
from sqlalchemy.orm import Session

from app.models import Diagnosis


class DiagnosisRepository:
    def __init__(self, session: Session):
        self.session = session

    def add(self, diagnosis: Diagnosis) -> None:
        self.session.add(diagnosis)
        self.session.flush()

    def get(self, diagnosis_id: str) -> Diagnosis | None:
        return self.session.scalar(sa.select(Diagnosis).where(Diagnosis.id == diagnosis_id))

    def locked(self, diagnosis_id: str) -> Diagnosis | None:
        """The diagnosis as it is now, held against other writers until the end of the transaction."""
        self._set(Diagnosis.id == diagnosis_id, attempt=Diagnosis.attempt)
        found = sa.select(Diagnosis).where(Diagnosis.id == diagnosis_id).execution_options(populate_existing=True)
        return self.session.scalar(found)

    def listed(self, limit: int, offset: int) -> tuple[list[Diagnosis], int]:
        total = self.session.scalar(sa.select(sa.func.count()).select_from(Diagnosis)) or 0
        query = sa.select(Diagnosis).order_by(Diagnosis.number.desc()).limit(limit).offset(offset)
        return list(self.session.scalars(query)), total

    def tell(self, diagnosis_id: str, attempt: int, doing: str, share: float) -> None:
        """How far an attempt is; one that was given up tells nothing."""
        this = (Diagnosis.id == diagnosis_id) & (Diagnosis.attempt == attempt)
        self._set(this, doing=doing, share=share)

    def cancel_requested(self, diagnosis_id: str) -> bool:
        query = sa.select(Diagnosis.cancel_requested_by).where(Diagnosis.id == diagnosis_id)
        return self.session.scalar(query) is not None

    def remove(self, diagnosis: Diagnosis) -> None:
        self.session.delete(diagnosis)
        self.session.flush()

    def _set(self, where: sa.ColumnElement[bool], **values: Any) -> None:
        change = sa.update(Diagnosis).where(where).values(**values)
        self.session.execute(change, execution_options={"synchronize_session": False})
