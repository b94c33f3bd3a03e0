"""JSON forms of rigs."""

from __future__ import annotations

from enum import StrEnum
from typing import Annotated

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field

from app.text import Named, Storable, integer
from app.whole import Whole
from rths_engine.planning.plan import MOST_STATIONS


class RigKind(StrEnum):
    """An emulated rig is a model in this program; a physical rig exists once."""

    EMULATED = "emulated"
    PHYSICAL = "physical"


class ActuatorCapacity(BaseModel):
    """The capacities of one actuator; null where a capacity is not known, and then not checked."""

    model_config = ConfigDict(extra="forbid", allow_inf_nan=False)

    name: Storable = Field("", max_length=80)
    stroke: float | None = Field(None, gt=0, le=10, description="largest displacement to either side, m")
    velocity: float | None = Field(None, gt=0, le=10, description="largest velocity, m/s")
    force: float | None = Field(None, gt=0, le=1e9, description="largest force, N")


class RigIn(BaseModel):
    """A rig as it is added."""

    model_config = ConfigDict(extra="forbid")

    name: Named = Field(max_length=80)
    kind: RigKind = RigKind.PHYSICAL
    tests_at_a_time: Annotated[int, Field(strict=True, ge=1, le=1000), BeforeValidator(integer)] | None = Field(
        None,
        description="number of tests at the same time; null: any number, or 1 on a physical rig",
    )
    actuators: list[ActuatorCapacity] = Field(
        [], max_length=MOST_STATIONS, description="capacities of the actuators; station 1 of a plan moves the first"
    )
    retired: bool = Field(False, description="a retired rig takes no more tests")


class RigChange(RigIn, Whole):
    """A rig as it is after a change: every field is given, so that none is reset by leaving it out."""


class RigOut(RigIn):
    """A rig, and how many tests run on it and wait for it."""

    model_config = ConfigDict(from_attributes=True)

    id: str
    name: str
    running: int
    queued: int


class RigList(BaseModel):
    """All rigs; the emulated laboratory of this program is the first."""

    rigs: list[RigOut]
