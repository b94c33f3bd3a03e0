"""Tables of measurements: raw files, recordings, saved mappings and batches."""

from __future__ import annotations

from datetime import datetime
from typing import Any

import sqlalchemy as sa
from sqlalchemy.orm import Mapped, mapped_column

from app.db import Base


class RawFile(Base):
    """An uploaded file of measurements, stored unchanged under its checksum."""

    __tablename__ = "raw_file"

    sha256: Mapped[str] = mapped_column(sa.String(64), primary_key=True)
    size: Mapped[int] = mapped_column(sa.BigInteger)
    filename: Mapped[str] = mapped_column(sa.String(255))
    uploaded_at: Mapped[datetime] = mapped_column(index=True)


class MeasuredRecording(Base):
    """Measurements imported from a raw file by a mapping. The HDF5 file is complete before the row exists."""

    __tablename__ = "measured_recording"

    number: Mapped[int] = mapped_column(primary_key=True)
    id: Mapped[str] = mapped_column(sa.String(36), unique=True)
    name: Mapped[str] = mapped_column(sa.String(200), index=True)
    test: Mapped[str | None] = mapped_column(sa.String(16))
    raw_sha256: Mapped[str] = mapped_column(sa.ForeignKey("raw_file.sha256"), index=True)
    filename: Mapped[str] = mapped_column(sa.String(255))
    mapping: Mapped[dict[str, Any]]
    channels: Mapped[list[dict[str, Any]]] = mapped_column(sa.JSON)
    warnings: Mapped[list[dict[str, Any]]] = mapped_column(sa.JSON)
    dt_s: Mapped[float]
    start_s: Mapped[float]
    samples: Mapped[int] = mapped_column(sa.BigInteger)
    imported_by: Mapped[str] = mapped_column(sa.String(80))
    imported_at: Mapped[datetime] = mapped_column(index=True)
    code_version: Mapped[str] = mapped_column(sa.String(40))
    sha256: Mapped[str] = mapped_column(sa.String(64))
    size: Mapped[int] = mapped_column(sa.BigInteger)

    @property
    def rate_hz(self) -> float:
        return 1 / self.dt_s

    @property
    def duration_s(self) -> float:
        return (self.samples - 1) * self.dt_s


class SavedMapping(Base):
    """A mapping saved under a name for files of one layout: of the same format, column names and units."""

    __tablename__ = "saved_mapping"

    number: Mapped[int] = mapped_column(primary_key=True)
    id: Mapped[str] = mapped_column(sa.String(36), unique=True)
    name: Mapped[str] = mapped_column(sa.String(200), unique=True)
    layout: Mapped[str] = mapped_column(sa.String(64), index=True)
    format: Mapped[str] = mapped_column(sa.String(200))
    columns: Mapped[list[dict[str, Any]]] = mapped_column(sa.JSON)
    mapping: Mapped[dict[str, Any]]
    saved_by: Mapped[str] = mapped_column(sa.String(80))
    saved_at: Mapped[datetime]


class ImportBatch(Base):
    """Many files imported by one mapping, and the table of what differs between them: a row for each file."""

    __tablename__ = "import_batch"

    number: Mapped[int] = mapped_column(primary_key=True)
    id: Mapped[str] = mapped_column(sa.String(36), unique=True)
    mapping: Mapped[dict[str, Any]]
    trust_mapping: Mapped[bool]
    reference: Mapped[str] = mapped_column(sa.Text)
    imported: Mapped[int]
    refused: Mapped[int]
    rows: Mapped[list[dict[str, Any]]] = mapped_column(sa.JSON)
    imported_by: Mapped[str] = mapped_column(sa.String(80))
    imported_at: Mapped[datetime]
