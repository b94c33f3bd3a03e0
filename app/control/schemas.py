"""JSON forms of the control of rigs and of the rules of the laboratory."""

from __future__ import annotations

from datetime import datetime
from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field

from app.text import Named, Storable

Approver = Annotated[Named, Field(max_length=80)]


class RulesIn(BaseModel):
    """The rules of the laboratory. A change gives all of them, so that none is switched off by leaving it out."""

    model_config = ConfigDict(extra="forbid", from_attributes=True)

    approvals: bool = Field(strict=True, description="another person approves each submission before it queues")
    approvers: list[Approver] = Field(
        max_length=50, description="people beside administrators who approve and reject; with accounts, names of accounts"
    )
    one_driver: bool = Field(strict=True, description="only the driver of a rig starts, holds, releases and cancels its tests")


class Driver(BaseModel):
    """The person who makes the request; with accounts it is the account, whatever stands here."""

    model_config = ConfigDict(extra="forbid")

    by: Storable = Field("", max_length=80)


class HandOver(Driver):
    """The person who drives, and the person who drives next."""

    to: Named = Field(max_length=80, description="with accounts, the name of an account that may operate")


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
    approvals: bool = Field(description="whether another person approves each submission, who then drives the rig instead")
    may_take_over: bool = Field(description="whether the person of the request may take a rig over")
    refusals: dict[str, str] = Field(description="rigs whose tests the person of the request may not change, and why")
    hold_refusal: str | None = Field(description="why the person of the request may not hold the queue; null: may")
    release_refusal: str | None = Field(description="why the person of the request may not release it; null: may")
    rigs: list[ControlOut]
