"""JSON forms of measured recordings. A mapping is JSON, or YAML as a string."""

from __future__ import annotations

from datetime import datetime
from typing import Any

from pydantic import BaseModel, ConfigDict, Field

from app.text import Storable


class Mapped(BaseModel):
    """An uploaded file, named by its checksum, and the mapping by which to read it."""

    model_config = ConfigDict(extra="forbid")

    file: str = Field(pattern="^[0-9a-f]{64}$", description="SHA-256 of the uploaded file")
    mapping: dict[str, Any] | str


class Import(Mapped):
    """An import: file, mapping, name of the recording, and the person who imports."""

    name: Storable = Field("", max_length=200)
    imported_by: Storable = Field("", max_length=80)


class RecordingOut(BaseModel):
    """A recording without its samples. Statistics of a channel are in its `unit`; the HDF5 file is in SI units."""

    model_config = ConfigDict(from_attributes=True)

    id: str
    name: str
    test: str | None
    filename: str
    raw_sha256: str
    channels: list[dict[str, Any]]
    warnings: list[dict[str, Any]]
    dt_s: float
    rate_hz: float
    start_s: float
    duration_s: float
    samples: int
    imported_by: str
    imported_at: datetime
    code_version: str
    sha256: str
    size: int


class RecordingDetail(RecordingOut):
    """A recording with its mapping."""

    mapping: dict[str, Any]


class RecordingList(BaseModel):
    """A page of recordings, and the total number."""

    recordings: list[RecordingOut]
    total: int


class EarlierMapping(BaseModel):
    """The mapping of an earlier import, and the newest recording that was imported by it."""

    recording: str
    name: str
    imported_at: datetime
    mapping: dict[str, Any]


class Uploaded(BaseModel):
    """The columns of an uploaded file, the proposed mapping, and the mappings of earlier imports that fit its columns."""

    sha256: str
    size: int
    filename: str
    format: str
    columns: list[dict[str, Any]]
    guess: dict[str, Any] | None
    reasons: dict[str, str]
    left_out: dict[str, str]
    notes: list[str]
    mappings: list[EarlierMapping]
