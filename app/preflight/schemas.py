"""JSON forms of a preflight."""

from __future__ import annotations

from typing import Literal

from pydantic import BaseModel, ConfigDict, Field

from app.openapi import Issue, PlanData
from app.text import Storable
from rths_engine.planning.plan import MOST_STATIONS


class CapacityIn(BaseModel):
    """The capacity of an actuator of a rig; null where it is not known."""

    model_config = ConfigDict(extra="forbid", allow_inf_nan=False)

    stroke: float | None = Field(None, gt=0, description="m")
    velocity: float | None = Field(None, gt=0, description="m/s")
    force: float | None = Field(None, gt=0, description="N")


class PreflightIn(BaseModel):
    """A plan, and the rig that it would run on: its id, or the capacities of its actuators, one entry for each station.

    Without both it is the emulated laboratory, as for a submission.
    """

    model_config = ConfigDict(extra="forbid")

    plan: PlanData
    rig: Storable | None = Field(None, max_length=36, description="id of the rig; its capacities are compared with the peaks")
    capacities: list[CapacityIn | None] = Field(
        [], max_length=MOST_STATIONS, description="instead of a rig: one entry for each station, in their order"
    )


class TripOut(BaseModel):
    """The trip that the dry run predicts. `path` is the field of the plan that holds the limit."""

    station: int = Field(description="counts from 1")
    name: str
    limit: str = Field(description="displacement, velocity, force or oscillation")
    words: str
    value: float | None = Field(description="SI; null where the value is not finite")
    bound: float
    unit: str
    shown: str
    time_s: float
    path: str
    sentence: str


class UseOut(BaseModel):
    """The largest magnitude of one quantity of a station against a safety limit or a capacity, SI."""

    station: int = Field(description="counts from 1")
    name: str
    quantity: str
    label: str
    against: Literal["limit", "actuator", "rig"]
    against_label: str
    path: str = Field(description="field of the plan that sets the bound")
    peak: float | None = Field(description="null where the quantity grows without bound")
    bound: float
    share: float | None = Field(description="peak / bound")
    time_s: float = Field(description="time of the peak")
    beyond_s: float | None = Field(description="first time beyond the bound; null where the bound holds")
    unit: str
    shown: str
    shown_label: str
    factor: float = Field(description="SI value of one shown unit")


class FloorsOut(BaseModel):
    """A measure of the floors, in its shown unit, from the lowest floor up."""

    key: str
    label: str
    meaning: str
    shown_label: str
    decimals: int
    values: list[float | None]


class MarginOut(BaseModel):
    """The delay margin of a station; null above 1000 controller steps."""

    station: int
    name: str
    steps: float | None
    seconds: float | None


class StabilityOut(BaseModel):
    """The predicted stability about rest; a value that was not determined in time is null or missing, and a note says so."""

    radius: float | None
    stable: bool | None
    stations: list[MarginOut]
    notes: list[str]


class PreflightOut(BaseModel):
    """The preflight of a plan. With `without_limits`, `uses` and `floors` are of a second simulation without safety limits.

    The verdict is `refused` where the rig would refuse the plan (`refusals`), whatever the dry run says.
    """

    name: str
    verdict: Literal["completes", "trips", "incomplete", "refused"]
    sentence: str
    refusals: list[Issue] = Field(description="what of the plan is too much for the rig; a submission gives the same errors")
    trip: TripOut | None
    without_limits: bool
    uses: list[UseOut]
    floors: list[FloorsOut]
    stability: StabilityOut | None = Field(description="null for a plan without a closed loop")
    open_ended: bool = Field(description="whether a client ends the test; `duration_s` is then the longest")
    duration_s: float = Field(description="duration of the test in simulated time, s")
    covered_s: float = Field(description="simulated time that `uses` and `floors` cover, s")
    expected_elapsed_s: float | None = Field(description="expected wall time of the test at its pace, s")
    notes: list[str]
