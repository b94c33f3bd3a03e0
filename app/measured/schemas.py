"""JSON forms of measured recordings. A mapping is JSON, or YAML as a string."""

from __future__ import annotations

from datetime import datetime
from typing import Any, Literal

from pydantic import BaseModel, ConfigDict, Field

from app.contents import Stated
from app.text import Named, PersonName, Storable


class Mapped(BaseModel):
    """An uploaded file, named by its checksum, and the mapping by which to read it."""

    model_config = ConfigDict(extra="forbid")

    file: str = Field(pattern="^[0-9a-f]{64}$", description="SHA-256 of the uploaded file")
    mapping: dict[str, Any] | str


class Preview(Mapped):
    """A preview: file, mapping, and the part of the time to show; by default all of it."""

    from_s: float | None = Field(None, allow_inf_nan=False, description="start of the part to show, s")
    to_s: float | None = Field(None, allow_inf_nan=False, description="end of the part to show, s")


class NewMapping(Mapped):
    """A mapping to save: a file that has the layout, the mapping, its name, and the person who saves it."""

    name: Named = Field(max_length=200)
    saved_by: PersonName = ""


class NewName(BaseModel):
    """A new name."""

    model_config = ConfigDict(extra="forbid")

    name: Named = Field(max_length=200)


class Import(Mapped):
    """An import: file, mapping, name of the recording, and the person who imports."""

    name: Storable = Field("", max_length=200)
    imported_by: PersonName = ""


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


class ReasonOut(BaseModel):
    """A reason against the import of a file."""

    where: str
    problem: str
    value: str | None
    fix: str | None
    lines: list[dict[str, Any]] = Field([], description="the line of the file that `where` names, with its neighbours")


class DifferenceOut(BaseModel):
    """A difference of a file from the other files of its batch."""

    severity: Literal["error", "warning", "note"] = Field(description="an error would change the meaning and refuses the file")
    what: str
    of: str
    here: str
    others: str
    text: str


class BatchRow(BaseModel):
    """A file of a batch: its recording, or the reasons against its import, and what differs."""

    file: str
    size: int
    sha256: str
    imported: bool
    recording: str | None = Field(description="null for a refused file, and for a recording that was deleted since")
    reasons: list[ReasonOut]
    differences: list[DifferenceOut]
    warnings: list[dict[str, Any]] = Field(description="findings of the checks, which the recording stores")
    format: str | None
    columns: int | None
    samples: int | None
    rate_hz: float | None
    start_s: float | None
    duration_s: float | None


class BatchSummary(BaseModel):
    """A batch without its rows."""

    model_config = ConfigDict(from_attributes=True)

    id: str
    imported: int = Field(description="number of imported files")
    refused: int
    reference: str = Field(description="the file that stands for the layout of most files")
    trust_mapping: bool
    imported_by: str
    imported_at: datetime


class BatchOut(BatchSummary):
    """Many files imported by one mapping: a row for each file, in the order of the files."""

    mapping: dict[str, Any]
    rows: list[BatchRow]


class BatchList(BaseModel):
    """A page of batches, and the total number."""

    batches: list[BatchSummary]
    total: int


class SavedMappingOut(BaseModel):
    """A saved mapping, and the layout of the files for which it is proposed."""

    model_config = ConfigDict(from_attributes=True)

    id: str
    name: str
    layout: str = Field(description="fingerprint of the format, and of the names and units of the columns")
    format: str
    columns: list[dict[str, str]]
    mapping: dict[str, Any]
    saved_by: str
    saved_at: datetime


class SavedMappingList(BaseModel):
    """All saved mappings."""

    mappings: list[SavedMappingOut]


class Uploaded(BaseModel):
    """An uploaded file: what stands in it, the proposed mapping with its reasons and doubts, and mappings that fit it."""

    sha256: str
    size: int
    filename: str
    format: str
    about: dict[str, str] = Field(description="title, event, station and the like, where the format has them")
    header: str = Field(description="the header as it stands in the file; at most 20 000 characters")
    header_characters: int = Field(description="length of the whole header")
    statements: list[Stated] = Field(description="what the header states, beside what was read")
    first_rows: list[list[float | None]] = Field(description="the first rows of numbers, one value for each column")
    columns: list[dict[str, Any]]
    guess: dict[str, Any] | None
    reasons: dict[str, str]
    doubtful: list[str] = Field(description="columns whose role is a guess from a name or a relation alone")
    left_out: dict[str, str]
    notes: list[str]
    layout: str = Field(description="fingerprint of the format, and of the names and units of the columns")
    saved: list[SavedMappingOut] = Field(description="mappings saved for files of this layout, newest first")
    mappings: list[EarlierMapping] = Field(description="mappings of earlier imports whose columns this file has")
