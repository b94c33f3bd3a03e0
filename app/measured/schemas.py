"""JSON forms of measured recordings. A mapping is given as JSON, or as text in YAML."""

from __future__ import annotations

from datetime import datetime
from typing import Any

from pydantic import BaseModel, ConfigDict, Field

from app.text import Storable


class Mapped(BaseModel):
    """An uploaded file, by its checksum, and how to read it."""

    model_config = ConfigDict(extra="forbid")

    file: str = Field(pattern="^[0-9a-f]{64}$", description="SHA-256 of the uploaded file")
    mapping: dict[str, Any] | str


class Import(Mapped):
    """What to keep of it, under which name, and who asks."""

    name: Storable = Field("", max_length=200)
    imported_by: Storable = Field("", max_length=80)


class RecordingOut(BaseModel):
    """A recording without its samples. Its channels' statistics are in their `unit`, as shown; the HDF5 is in SI."""

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
    """A page of recordings and their number in all."""

    recordings: list[RecordingOut]
    total: int


class EarlierMapping(BaseModel):
    """The mapping of an earlier import, the newest where several used the same."""

    recording: str
    name: str
    imported_at: datetime
    mapping: dict[str, Any]


class Uploaded(BaseModel):
    """What is in an uploaded file, the mapping guessed for it and the earlier ones whose columns it has."""

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
