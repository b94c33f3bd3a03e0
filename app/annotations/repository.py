"""SQL of annotations. Never commits."""

from __future__ import annotations

import sqlalchemy as sa
from sqlalchemy.orm import Session

from app.db import locked
from app.models import Annotation


class AnnotationRepository:
    """SQL of annotations. Never commits."""

    def __init__(self, session: Session):
        self.session = session

    def of(self, run_number: int) -> list[Annotation]:
        """The annotations of a run in order of time."""
        query = sa.select(Annotation).where(Annotation.run_number == run_number)
        return list(self.session.scalars(query.order_by(Annotation.from_s, Annotation.row)))

    def locked(self, run_number: int, annotation_id: str) -> Annotation | None:
        """The annotation as it is now, locked against other writers until the end of the transaction."""
        return locked(self.session, Annotation, run_number=run_number, id=annotation_id)

    def add(self, annotation: Annotation) -> None:
        self.session.add(annotation)
        self.session.flush()

    def remove(self, annotation: Annotation) -> None:
        self.session.delete(annotation)
        self.session.flush()
