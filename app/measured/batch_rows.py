"""SQL of batches of imported files. Never commits."""

from __future__ import annotations

from collections.abc import Iterable

import sqlalchemy as sa
from sqlalchemy.orm import Session

from app.models import ImportBatch, MeasuredRecording


class BatchRows:
    """SQL of batches of imported files. Never commits."""

    def __init__(self, session: Session):
        self.session = session

    def add(self, batch: ImportBatch) -> None:
        self.session.add(batch)
        self.session.flush()

    def get(self, batch_id: str) -> ImportBatch | None:
        return self.session.scalar(sa.select(ImportBatch).where(ImportBatch.id == batch_id))

    def listed(self, limit: int, offset: int) -> tuple[list[ImportBatch], int]:
        total = self.session.scalar(sa.select(sa.func.count()).select_from(ImportBatch)) or 0
        query = sa.select(ImportBatch).order_by(ImportBatch.number.desc()).limit(limit).offset(offset)
        return list(self.session.scalars(query)), total

    def existing(self, recordings: Iterable[str]) -> set[str]:
        """The identifiers, of those given, of recordings that exist."""
        return set(self.session.scalars(sa.select(MeasuredRecording.id).where(MeasuredRecording.id.in_(list(recordings)))))
