"""SQL of raw files and measured recordings. Never commits."""

from __future__ import annotations

from datetime import UTC, datetime

import sqlalchemy as sa
from sqlalchemy.orm import Session

from app.db import INSERT, Base, lock
from app.models import MeasuredRecording, RawFile

RECORDED = MeasuredRecording.raw_sha256 == RawFile.sha256


class MeasuredRepository:
    """SQL of measured recordings and uploaded files. Never commits."""

    def __init__(self, session: Session):
        self.session = session

    def keep_raw(self, sha256: str, size: int, filename: str) -> None:
        """Add the row of a file or renew the existing row, and lock it until the end of the transaction."""
        row = {"sha256": sha256, "size": size, "filename": filename, "uploaded_at": datetime.now(UTC)}
        insert = INSERT[self.session.get_bind().dialect.name](RawFile.__table__).values(row)
        newer = {"filename": filename, "uploaded_at": row["uploaded_at"]}
        self.session.execute(insert.on_conflict_do_update(index_elements=["sha256"], set_=newer))

    def held(self, sha256: str) -> bool:
        """Hold the place of a file without row until the end of the transaction; returns whether it has none."""
        row = {"sha256": sha256, "size": 0, "filename": "", "uploaded_at": datetime.now(UTC)}
        insert = INSERT[self.session.get_bind().dialect.name](RawFile.__table__).values(row)
        found = self.session.execute(insert.on_conflict_do_nothing(index_elements=["sha256"]))
        return bool(found.rowcount)  # type: ignore[attr-defined]

    def raw(self, sha256: str) -> RawFile | None:
        return self.session.get(RawFile, sha256, populate_existing=True)

    def locked_raw(self, sha256: str) -> bool:
        """Whether the row of a file exists; if so, it is locked until the end of the transaction."""
        return lock(self.session, RawFile.size, RawFile.sha256 == sha256)

    def forget_raw(self, sha256: str) -> bool:
        """Delete the row of a file unless a recording was imported from it; returns whether the row was deleted."""
        unused = sa.delete(RawFile).where(RawFile.sha256 == sha256, ~sa.exists().where(RECORDED))
        return bool(self.session.execute(unused).rowcount)  # type: ignore[attr-defined]

    def abandoned(self, before: datetime) -> list[str]:
        """Files uploaded before `before` from which no recording was imported."""
        query = sa.select(RawFile.sha256).where(RawFile.uploaded_at < before, ~sa.exists().where(RECORDED))
        return list(self.session.scalars(query))

    def add(self, recording: MeasuredRecording) -> None:
        self.session.add(recording)
        self.session.flush()

    def get(self, recording_id: str) -> MeasuredRecording | None:
        return self.session.scalar(sa.select(MeasuredRecording).where(MeasuredRecording.id == recording_id))

    def listed(self, limit: int, offset: int) -> tuple[list[MeasuredRecording], int]:
        total = self.session.scalar(sa.select(sa.func.count()).select_from(MeasuredRecording)) or 0
        query = sa.select(MeasuredRecording).order_by(MeasuredRecording.number.desc()).limit(limit).offset(offset)
        return list(self.session.scalars(query)), total

    def uses(self, recording: MeasuredRecording) -> dict[str, int]:
        """Number of rows that refer to the recording, by table."""
        found: dict[str, int] = {}
        for table in Base.metadata.sorted_tables:
            for column in table.columns:
                for target in (key.column for key in column.foreign_keys if key.column.table.name == recording.__tablename__):
                    query = sa.select(sa.func.count()).where(column == getattr(recording, target.name))
                    found[table.name] = found.get(table.name, 0) + (self.session.scalar(query) or 0)
        return {name: count for name, count in found.items() if count}

    def remove(self, recording: MeasuredRecording) -> None:
        self.session.delete(recording)
        self.session.flush()
