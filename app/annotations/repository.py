"""SQL of annotations. Never commits."""

from __future__ import annotations

import sqlalchemy as sa
from sqlalchemy.orm import Session

from app.models import Annotation


class AnnotationRepository:
    """SQL of annotations. Never commits."""

    def __init__(self, session: Session):
        self.session = session

    def of(self, run_number: int) -> list[Annotation]:
        """The annotations of a run in order of time."""
        query = sa.select(Annotation).where(Annotation.run_number == run_number)
        return list(self.session.scalars(query.order_by(Annotation.from_s, Annotation.row)))

    def get(self, run_number: int, annotation_id: str) -> Annotation | None:
        query = sa.select(Annotation).where(Annotation.run_number == run_number, Annotation.id == annotation_id)
        return self.session.scalar(query)

    def add(self, annotation: Annotation) -> None:
        self.session.add(annotation)
        self.session.flush()

    def remove(self, annotation: Annotation) -> None:
        self.session.delete(annotation)
        self.session.flush()
