"""JSON forms of an identification."""

from __future__ import annotations

from pydantic import BaseModel, ConfigDict, Field, model_validator

from app.openapi import PlanData
from app.text import Integer


class IdentificationIn(BaseModel):
    """A plan, one of its stations, and the random test of it. SI."""

    model_config = ConfigDict(extra="forbid", allow_inf_nan=False)

    plan: PlanData
    station: Integer = Field(1, ge=1, le=1000, description="counts from 1")
    seconds: float = Field(20.0, ge=5, le=30, description="duration of the random test, s")
    low_frequency: float = Field(0.25, ge=0.05, le=50, description="Hz")
    high_frequency: float = Field(6.0, ge=0.5, le=100, description="Hz; at least twice the lowest frequency")
    amplitude: float | None = Field(None, ge=1e-6, le=1, description="peak displacement, m; null: chosen from the limits")
    seed: int = Field(0, ge=0, le=2**63 - 2, description="seed of the random command")

    @model_validator(mode="after")
    def _band(self) -> IdentificationIn:
        if self.high_frequency < 2 * self.low_frequency:
            raise ValueError(f"high_frequency needs to be at least twice low_frequency, {self.low_frequency:g} Hz")
        return self


class IntervalOut(BaseModel):
    """An estimate with its 95 % interval."""

    value: float
    low: float
    high: float


class ParameterOut(IntervalOut):
    """A parameter of a fitted model, SI."""

    key: str
    label: str
    unit: str
    shown_label: str
    factor: float = Field(description="SI value of one shown unit")
    determined: bool = Field(description="false where it reaches a bound of the fit: the test does not determine it")


class FittedOut(BaseModel):
    """A model fitted to the random test."""

    kind: str
    title: str
    parameters: list[ParameterOut]
    delay: IntervalOut = Field(description="delay of slow motion, s; of a pure delay, the slope of the phase")
    residual: float = Field(description="RMS of the residual over the RMS of the measured displacement")


class SmallerOut(BaseModel):
    """The delay constant at a quarter of the amplitude."""

    amplitude: float = Field(description="m")
    alpha: IntervalOut


class SuggestedOut(BaseModel):
    """A field of the plan's compensator that describes the actuator, with its value for the best model. SI."""

    field: str
    path: str
    label: str
    value: float
    present: float
    shown_label: str
    factor: float = Field(description="SI value of one shown unit")


class IdentificationOut(BaseModel):
    """The identified delay of a station."""

    station: int
    name: str
    seconds: float
    low_frequency: float
    high_frequency: float
    amplitude: float = Field(description="peak displacement of the random test, m")
    rms_displacement: float
    rms_velocity: float
    controller_step: float = Field(description="s; a delay over it, plus 1, is alpha")
    coherence: float = Field(description="mean coherence in the band")
    models: list[FittedOut]
    best: str = Field(description="kind of the model with the smallest residual")
    delay: IntervalOut = Field(description="delay of the best model, s")
    smaller_amplitude: SmallerOut
    suggested: list[SuggestedOut]
    notes: list[str]
