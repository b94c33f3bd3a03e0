"""JSON forms of plans before they are run."""

from __future__ import annotations

from typing import Any

from pydantic import BaseModel, Field

from app.openapi import PlanData


class TemplateOut(BaseModel):
    """The plan of a template, and the paper's results if the template is a simulation of Table III."""

    name: str
    plan: PlanData
    paper: dict[str, Any] | None


class Summary(BaseModel):
    """Periods, number of steps, duration and ground motion of a plan."""

    periods_s: list[float] = Field(description="natural periods, s, from the first mode on")
    steps: int = Field(description="number of integration steps")
    duration_s: float
    pga: float | None = Field(description="peak ground acceleration, m/s^2; null without ground motion")
    scale_factor: float | None


class CheckOut(BaseModel):
    """A checked plan with every default, its digest, warnings and a summary."""

    plan: PlanData
    digest: str
    warnings: list[str]
    summary: Summary
