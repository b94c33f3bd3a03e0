"""SQL of saved mappings. Never commits."""

from __future__ import annotations

import sqlalchemy as sa
from sqlalchemy.orm import Session

from app.db import locked
from app.models import SavedMapping

MOST = 1000  # listed


class MappingRows:
    """SQL of saved mappings. Never commits."""

    def __init__(self, session: Session):
        self.session = session

    def add(self, saved: SavedMapping) -> None:
        self.session.add(saved)
        self.session.flush()

    def listed(self, layout: str | None = None) -> list[SavedMapping]:
        """Saved mappings, newest first: all of them, or those of one layout."""
        query = sa.select(SavedMapping).order_by(SavedMapping.number.desc()).limit(MOST)
        return list(self.session.scalars(query if layout is None else query.where(SavedMapping.layout == layout)))

    def get(self, mapping_id: str) -> SavedMapping | None:
        return self.session.scalar(sa.select(SavedMapping).where(SavedMapping.id == mapping_id))

    def locked(self, mapping_id: str) -> SavedMapping | None:
        """The mapping as it is now, locked against other writers until the end of the transaction."""
        return locked(self.session, SavedMapping, id=mapping_id)

    def named(self, name: str) -> SavedMapping | None:
        return self.session.scalar(sa.select(SavedMapping).where(SavedMapping.name == name))

    def remove(self, saved: SavedMapping) -> None:
        self.session.delete(saved)
        self.session.flush()
