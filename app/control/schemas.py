"""JSON forms of the control of rigs and of the rules of the laboratory."""

from __future__ import annotations

from datetime import datetime

from pydantic import BaseModel, ConfigDict, Field

from app.text import Named, Storable


class RulesIn(BaseModel):
    """The rules of the laboratory."""

    model_config = ConfigDict(extra="forbid", from_attributes=True)

    approvals: bool = Field(False, description="another person approves each submission before it queues")
    approvers: list[Named] = Field([], max_length=50, description="people beside administrators who approve and reject")
    one_driver: bool = Field(False, description="only the driver of a rig starts, holds, releases and cancels its tests")


class Driver(BaseModel):
    """The person who makes the request; with accounts it is the account, whatever stands here."""

    model_config = ConfigDict(extra="forbid")

    by: Storable = Field("", max_length=80)


class HandOver(Driver):
    """The person who drives, and the person who drives next."""

    to: Named = Field(max_length=80)


class TakeOver(Driver):
    """The administrator who takes a rig over, and why."""

    reason: Named = Field(max_length=200)


class ControlOut(BaseModel):
    """Who drives a rig."""

    rig_id: str
    rig_name: str
    driver: str | None = Field(description="null: nobody drives the rig")
    since: datetime | None
    until: datetime | None = Field(description="end of the control unless it is renewed")
    asked_by: str | None = Field(description="who asks for the control")
    yours: bool = Field(description="whether the person of the request drives it")
    sentence: str


class ControlList(BaseModel):
    """Who drives each rig that takes tests."""

    one_driver: bool = Field(description="whether the laboratory has the rule that one person drives a rig")
    may_take_over: bool = Field(description="whether the person of the request may take a rig over")
    rigs: list[ControlOut]
