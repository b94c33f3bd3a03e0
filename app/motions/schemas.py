"""JSON forms of files of ground motions."""

from __future__ import annotations

from typing import Literal

from pydantic import BaseModel, Field

from app.contents import Stated


class MotionChannel(BaseModel):
    """A channel of acceleration in a file. `unit` is as the file writes it; null: not stated."""

    number: int
    name: str
    unit: str
    dt_s: float | None
    samples: int
    largest: float = Field(description="largest absolute value, in the unit of the file")
    applied: str = Field(description="scale factor or gain of the file that the values contain")
    asks: list[Literal["unit", "count", "dt"]] = Field(
        description="what the file does not state: `unit`, `dt`; count: give the acceleration of one count as `unit`"
    )


class MotionFile(BaseModel):
    """What stands in a file of ground motions."""

    filename: str
    format: str
    about: dict[str, str]
    header: str = Field(description="the header as it stands in the file; at most 20 000 characters")
    header_characters: int
    statements: list[Stated]
    first_rows: list[list[float | None]] = Field(description="the first rows of all columns")
    columns: list[str] = Field(description="names of all columns, those that are not acceleration too")
    notes: list[str]
    channels: list[MotionChannel]
