"""JSON forms of annotations."""

from __future__ import annotations

from datetime import datetime
from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field

from app.text import PersonName, Storable

LATEST = 1e9  # s; the service compares a time with the duration of the run
Time = Annotated[float, Field(ge=0, le=LATEST, allow_inf_nan=False)]

Number = Annotated[int, Field(ge=1, le=100)]


class Written(BaseModel):
    """What a person writes at a time or over a span of a run, on one station or on the whole test."""

    model_config = ConfigDict(extra="forbid")

    from_s: Time = Field(description="time of the annotation, or the start of its span, s")
    to_s: Time | None = Field(None, description="end of the span, s; null for a single time")
    station: Annotated[int, Field(ge=1, le=100)] | None = Field(
        None, description="number of a station; null for the whole test"
    )
    text: Storable = Field(min_length=1, max_length=2000)
    by: PersonName = ""


class AnnotationOut(Written):
    """An annotation of a run. `edited_at` is null while nobody has changed it."""

    model_config = ConfigDict(from_attributes=True)

    id: str
    number: int = Field(description="number of its mark on the charts, in order of time")
    created_at: datetime
    edited_at: datetime | None


class AnnotationList(BaseModel):
    """The annotations of a run in order of time."""

    annotations: list[AnnotationOut]
