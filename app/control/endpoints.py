"""REST endpoints of the control of rigs and of the rules of the laboratory."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Body, Query

from app.access import Role, Who, allowed
from app.control.dependency import Controlled
from app.control.schemas import ControlList, ControlOut, Driver, HandOver, RulesIn, TakeOver
from app.text import Storable

router = APIRouter(prefix="/api/v1", tags=["control"])
NOBODY = Driver()


@router.get("/rules")
@allowed(Role.VIEWER)
def rules(control: Controlled) -> RulesIn:
    """The rules of the laboratory: all are off at first."""
    return control.rules()


@router.put("/rules")
@allowed(Role.ADMINISTRATOR)
def save_rules(control: Controlled, who: Who, given: Annotated[RulesIn, Body()]) -> RulesIn:
    """Set all rules of the laboratory. With accounts, each approver is an account with at least the role operator."""
    return control.save_rules(given, who.how != "local")


@router.get("/control")
@allowed(Role.VIEWER)
def shown(control: Controlled, who: Who, by: Annotated[Storable, Query(max_length=80)] = "") -> ControlList:
    """Who drives each rig. `by` is the name of the reader where there are no accounts."""
    return control.shown(who.named(by), who.role is Role.ADMINISTRATOR)


@router.post("/control/{rig_id}/take")
@allowed(Role.OPERATOR)
def take(rig_id: str, control: Controlled, who: Who, person: Annotated[Driver, Body()] = NOBODY) -> ControlOut:
    """Take the control of a rig that nobody drives. It ends 10 minutes after its last renewal."""
    return control.take(rig_id, who.named(person.by))


@router.post("/control/{rig_id}/renew")
@allowed(Role.OPERATOR)
def renew(rig_id: str, control: Controlled, who: Who, person: Annotated[Driver, Body()] = NOBODY) -> ControlOut:
    """Keep the control for a further 10 minutes. An open page of the driver does so every minute."""
    return control.renew(rig_id, who.named(person.by))


@router.post("/control/{rig_id}/release")
@allowed(Role.OPERATOR)
def release(rig_id: str, control: Controlled, who: Who, person: Annotated[Driver, Body()] = NOBODY) -> ControlOut:
    """Give the control back, so that nobody drives the rig."""
    return control.release(rig_id, who.named(person.by))


@router.post("/control/{rig_id}/request")
@allowed(Role.OPERATOR)
def request(rig_id: str, control: Controlled, who: Who, person: Annotated[Driver, Body()] = NOBODY) -> ControlOut:
    """Ask who drives a rig for its control. The pages of the driver show who asks."""
    return control.ask(rig_id, who.named(person.by))


@router.post("/control/{rig_id}/hand-over")
@allowed(Role.OPERATOR)
def hand_over(rig_id: str, control: Controlled, who: Who, given: Annotated[HandOver, Body()]) -> ControlOut:
    """Give the control of a rig to another person. With accounts, it is an account with at least the role operator."""
    return control.hand_over(rig_id, who.named(given.by), given.to, who.how != "local")


@router.post("/control/{rig_id}/take-over")
@allowed(Role.ADMINISTRATOR)
def take_over(rig_id: str, control: Controlled, who: Who, given: Annotated[TakeOver, Body()]) -> ControlOut:
    """Take the control of a rig from the person who has it, with a reason, which the audit log keeps."""
    return control.take_over(rig_id, who.named(given.by))
