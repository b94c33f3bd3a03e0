"""JSON forms of plans before they are run."""

from __future__ import annotations

from typing import Any

from pydantic import BaseModel, Field

from app.openapi import PlanData


class TemplateOut(BaseModel):
    """A template's plan, and the paper's row where it is a simulation of Table III."""

    name: str
    plan: PlanData
    paper: dict[str, Any] | None


class Summary(BaseModel):
    """What a plan amounts to."""

    periods_s: list[float] = Field(description="natural periods, the first mode's first")
    steps: int = Field(description="integration steps")
    duration_s: float
    pga: float | None = Field(description="peak ground acceleration, m/s^2; null without ground motion")
    scale_factor: float | None


class CheckOut(BaseModel):
    """A plan as it is understood, every default written out."""

    plan: PlanData
    digest: str
    warnings: list[str]
    summary: Summary
