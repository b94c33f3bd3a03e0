"""JSON forms of a comparison. Each list of values has one value for each item, in the order of the items."""

from __future__ import annotations

from typing import Any, Literal

from pydantic import BaseModel, Field


class StationName(BaseModel):
    """A station of an item."""

    number: int
    name: str


class ItemOut(BaseModel):
    """A run or an imported recording of a comparison."""

    ref: str = Field(description="`run:ID` or `recording:ID`")
    kind: Literal["run", "recording"]
    id: str
    label: str = Field(description="short name, such as `Run 12`")
    name: str
    test: str | None = Field(description="kind of test; null where the import does not say it")
    state: str | None = Field(description="status of the run; null for an imported recording")
    reason: str | None = Field(description="why the run ended")
    has_plan: bool
    dt_s: float
    rate_hz: float
    start_s: float = Field(description="time of the first sample")
    duration_s: float
    samples: int
    stations: list[StationName]
    floors: int
    channels: list[str] = Field(description="keys of the channels, such as `x_cmd.1`")
    computed: list[str] = Field(description="keys of channels that are computed from the others here")


class NoteOut(BaseModel):
    """A difference of the items in words, which an overlay does not show."""

    about: Literal[
        "excitation", "test", "sampling", "duration", "start", "stations", "channels", "computed", "plan", "measures"
    ]
    sentence: str


class FieldOut(BaseModel):
    """A field in which the plans differ."""

    path: str
    within: str = Field(description="names of the parts around the field")
    label: str
    unit: str = Field(description="unit of `texts`; empty where there is none")
    values: list[Any] = Field(description="SI, as in the plan; null where the plan has no such field")
    texts: list[str | None] = Field(description="values in the shown unit; null for an item without plan")
    differs: list[bool] = Field(description="whether the value differs from that of the reference")


class DifferenceOut(BaseModel):
    """The difference of a measure to that of the reference."""

    absolute: float
    percent: float | None = Field(description="of the magnitude of the reference; null where that is 0")


class MeasureOut(BaseModel):
    """A measure of each item, in the unit shown."""

    where: str = Field(description="`Station 1`, `Floor 2` or `Whole test`")
    key: str
    label: str
    meaning: str
    unit: str
    further: bool
    values: list[float | None]
    differences: list[DifferenceOut | None]


class RoleOut(BaseModel):
    """A role of channels that can be drawn."""

    role: str
    label: str
    unit: str


class ComparisonOut(BaseModel):
    """A comparison of 2 to 20 runs or recordings. `reference` is the index of the item that the others are compared with."""

    items: list[ItemOut]
    reference: int
    notes: list[NoteOut]
    fields: list[FieldOut]
    measures: list[MeasureOut]
    roles: list[RoleOut]


class CandidateOut(BaseModel):
    """A run or a recording that can be compared."""

    ref: str
    label: str
    name: str
    test: str | None
    state: str | None
    at: str = Field(description="time of the submission or import, UTC")


class PreviousOut(BaseModel):
    """The run before a run of the same template, or of the same name; null where there is none."""

    previous: CandidateOut | None
    address: str | None = Field(description="the page that compares both runs")
